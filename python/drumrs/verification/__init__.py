"""The proof that anyone can run: every law, identity and promise as a case with its expected and measured numbers.

A case is a function that returns `Evidence`: numbers held against numbers, and a picture of measured points on the
expected curve. Its docstring says why the tolerance is what it is; `theory` says how far the scheme may be off.
"""

from drumrs.verification.case import Case, Trial
from drumrs.verification.catalog import FAMILIES
from drumrs.verification.evidence import Check, Evidence, Panel, Trace
from drumrs.verification.runner import Verification, verify

__all__ = ["FAMILIES", "Case", "Check", "Evidence", "Panel", "Trace", "Trial", "Verification", "verify"]
