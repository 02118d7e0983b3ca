"""`calibrate`: parameters of the model from measured numbers, as a probability, by emulators of few runs."""

from collections.abc import Mapping
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

import numpy as np

from drumrs.decide.calibration import Calibration
from drumrs.decide.emulator import Array, require_packages
from drumrs.decide.evaluate import Evaluator
from drumrs.decide.measurement import Experiment
from drumrs.decide.posterior import fit
from drumrs.folders import claim, require_own
from drumrs.pictures import attempt
from drumrs.progress import Task
from drumrs.tables import write_table

# What a calibration writes into its folder.
FILES = ("posterior.parquet", "calibration.png", "runs")


def calibrate(
    experiment: Experiment | str | Path | Mapping[str, Any],
    out: str | Path,
    *,
    executor: Executor | str | None = None,
    jobs: int | None = None,
    progress: bool = True,
) -> Calibration:
    """Find out which parameters measured numbers leave, and how sure that is.

    Points of the parameters' ranges are simulated, once for each drum that differs; a Gaussian process for each number
    that was measured says what others would give. Then the parameters have a probability: that of the measurements,
    which are normal with their errors, the emulator's, and what the model itself may be off by. The best fit alone
    would hide that several parameters may fit alike.

    Parameters
    ----------
    experiment
        TOML file with ``[base]``, ``[ranges]``, ``[[measured]]``, ``[[candidate]]`` and ``[calibrate]``, or what
        `Experiment.read` takes else.
    out
        Folder for posterior.parquet, calibration.png and the runs; nothing in it is simulated twice.
    executor, jobs
        Who runs the cases, and how many at once, as for `drumrs.Sweep.run`.
    progress
        Whether to show progress.

    Raises
    ------
    ConfigError
        Where scikit-learn or emcee is missing, a key or value is not accepted, the folder is of something else, or too
        few runs have a number for what was measured.
    OSError
        Where results cannot be written; what is finished is kept.
    KeyboardInterrupt
        After Ctrl-C; what is finished is kept.

    Examples
    --------
    >>> import tempfile, drumrs
    >>> experiment = {
    ...     "base": drumrs.baseline(fill=0.05).replace({"run.duration": 0.1}),
    ...     "ranges": {"contact.bundle.friction": [0.1, 0.6]},
    ...     "measured": [{"target": "drum_specific_power", "value": 1.0, "error": 0.5}],
    ...     "calibrate": {"runs": 6},
    ... }
    >>> found = drumrs.calibrate(experiment, tempfile.mkdtemp(), progress=False)
    >>> found.table["parameter"].to_list()
    ['contact.bundle.friction']
    """
    require_packages("a calibration", "sklearn", "emcee")
    wanted = experiment if isinstance(experiment, Experiment) else Experiment.read(experiment)
    folder = Path(out)
    require_own(folder, "calibration", FILES)
    claim(folder, "calibration", ", ".join(map(str, wanted.measured)), "")
    outputs, drums = (*wanted.measured, *wanted.candidates), wanted.drums
    targets = list(dict.fromkeys(one.target for one in outputs))
    ask = Evaluator(targets, folder / "runs", executor=executor, jobs=jobs, progress=progress)
    columns = [(drums.index(one.settings), targets.index(one.target)) for one in outputs]
    with Task("calibration", wanted.runs * len(drums), detail=f"{len(drums)} drums", show=progress) as task:

        def evaluate(points: Array, first: int) -> tuple[Array, Array]:
            configs = [
                wanted.base.replace(
                    {
                        **dict(settings),
                        **wanted.space.values(point),
                        "run.seed": wanted.base.run.seed + first + k,
                    }
                )
                for k, point in enumerate(points)
                for settings in drums
            ]
            means = ask.means(configs)
            task.update((first + len(points)) * len(drums))
            rows = [means[k * len(drums) : (k + 1) * len(drums)] for k in range(len(points))]
            found = [[row[drum][target] for drum, target in columns] for row in rows]
            return (
                np.array([[mean.value for mean in row] for row in found]),
                np.array([[np.nan if mean.error is None else mean.error for mean in row] for row in found]),
            )

        values, errors = wanted.numbers
        posterior = fit(wanted.space, evaluate, values, errors, wanted.runs)
    found = Calibration(wanted, posterior)
    write_table(folder / "posterior.parquet", found.samples, {})
    with attempt(folder / "calibration.png"):
        from drumrs.figures import write

        write(found.figure(), folder / "calibration.png")
    return found
