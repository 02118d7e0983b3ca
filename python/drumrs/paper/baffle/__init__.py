"""The paper's baffle, whose drawing is lost, inferred from every sentence that speaks of it.

`shape` says which shapes are searched, `evidence` what the paper says of them, `design` what is simulated,
`observations` what that tells; `emulator` foretells the shapes that were not run, `posterior` weighs them, `inference`
ties it together, `page` writes it down with its `figure`.
"""

from drumrs.paper.baffle.design import Plan
from drumrs.paper.baffle.inference import Inference, infer_baffle
from drumrs.paper.baffle.shape import Shape

__all__ = ["Inference", "Plan", "Shape", "infer_baffle"]
