"""Facts about a study: how much was computed and how long it took, and how to cite."""

from drumrs.pages.provenance import now
from drumrs.paper.data import StudyData
from drumrs.paper.report.table1 import scientific
from drumrs.progress import format_duration

# The citation, as in CITATION.cff.
SOFTWARE = "drumrs: discrete-element simulation of loads tumbling in a rotating drum"
AUTHORS = "The drumrs authors"
PAPER = "Dynamic Analysis of Fabric in a Rotating Horizontal Drum Using the Discrete Element Method"
PAPER_AUTHORS = "J. Park and C. R. Wassgren"


def times(data: StudyData) -> dict[str, str]:
    """Return what was computed and how long it took, by name."""
    facts = data.sweep.facts(data.folder)
    steps = sum(case.cost for case in data.sweep.cases if case.id in set(facts["case"]))
    spent = float(facts["wall_time"].sum())
    told = {
        "runs finished": f"{data.table.height} of {len(data.sweep)}",
        "particle-steps": scientific(steps),
        "computing time, all runs": format_duration(spent),
    }
    if spent > 0.0:
        told["speed of one run"] = f"{steps / spent / 1e6:.3g} million particle-steps per second"
    if data.wall_time is not None:
        told["time of the last call"] = format_duration(data.wall_time)
    machines = sorted({name for name in facts["machine"] if name})
    if len(machines) > 1:
        told["machines"] = ", ".join(machines)
    return {**told, "report written": now()}
