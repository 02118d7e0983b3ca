"""`drumrs movie`: a run as a film."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from drumrs.cli.options import NUMBER, PATH, WHOLE
from drumrs.cli.tables import print_paths
from drumrs.errors import ConfigError


def movie(
    run: Path,
    /,
    *,
    out: Annotated[Path | None, PATH] = None,
    case: Annotated[list[str] | None, Parameter(negative="")] = None,
    color: str = "speed",
    speed: Annotated[float, NUMBER] = 1.0,
    fps: Annotated[int, WHOLE] = 25,
    width: Annotated[int, WHOLE] = 720,
    start: Annotated[float | None, NUMBER] = None,
    end: Annotated[float | None, NUMBER] = None,
    force: Annotated[bool, Parameter(negative="")] = False,
) -> None:
    """Write a run as a film: the drum, bundles in colors, and the power as it goes.

    A film as mp4 needs the extra: pip install 'drumrs[movie]'. gif and webp need nothing else, and are larger.

    Parameters
    ----------
    run
        Folder of a run, its frames.parquet, or a sweep's folder with the beginning of a case's id: out/study/3f2a.
    out
        File whose name ends in .mp4, .gif or .webp. Without it: an mp4 beside the frames.
    case
        Which case of a sweep's folder: KEY=VALUE of its configuration; may be repeated.
    color
        What colors stand for: speed, species, or height, that at the first picture, which shows mixing.
    speed
        Simulated seconds in a second of the film.
    fps
        Pictures in a second, at most; there are no more than there are frames.
    width
        Width [pixels].
    start, end
        Part of the run to be shown [s]; all unless given.
    force
        Replace a file that is there.
    """
    from drumrs import exports

    frames, recorded = exports.read(run, case or [])
    path = out or frames.with_suffix(".mp4")
    window = (start if start is not None else -1.0, end if end is not None else float("inf"))
    try:
        exports.movie(
            recorded, path, color=color, speed=speed, fps=fps, width=width, window=window, force=force
        )
    except OSError as error:
        limit = f"a file that can be written: {error.strerror or error}"
        raise ConfigError("--out", path, limit) from None
    print_paths([path])
