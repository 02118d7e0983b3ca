"""The paper's baffle, whose drawing is lost, inferred from every sentence that speaks of it.

`paper.shape` says which shapes are searched, `sentences` what the paper says of them, as `evidence`; `design` says what
is simulated, `observations` what that tells; `emulator` predicts the shapes that were not run, `posterior` weighs
them; `findings` is what is known in the end, `page` writes it down with its `figure`, `inference` ties it together.
"""

from drumrs.paper.baffle.design import Plan
from drumrs.paper.baffle.findings import Inference
from drumrs.paper.baffle.inference import infer_baffle
from drumrs.paper.shape import Shape

__all__ = ["Inference", "Plan", "Shape", "infer_baffle"]
