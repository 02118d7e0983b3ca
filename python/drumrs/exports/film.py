"""`movie`: a run as a film, mp4 by ffmpeg, gif and webp by Pillow."""

import math
import subprocess
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from drumrs.errors import ConfigError, missing_package
from drumrs.exports.recorded import Recorded
from drumrs.files import replacing
from drumrs.frames import Frames
from drumrs.progress import Task
from drumrs.result import Result
from drumrs.unstable import UnstableRun

if TYPE_CHECKING:
    from PIL.Image import Image

    from drumrs.figures import Film

Picture = NDArray[np.uint8]
# Greatest number of pictures in a second, and greatest width [pixels].
_MOST_RATE, _MOST_WIDTH = 60, 3840
_LEAST_WIDTH = 240
_MOST_MEMORY = 2**30
# x264's scale of loss, on which 18 is said to be without visible loss.
_LOSS = "23"
_GIF_COLORS = 128


def movie(  # noqa: PLR0913 - a film has as many choices
    run: Result | UnstableRun | Recorded,
    path: str | Path,
    *,
    color: str = "speed",
    speed: float = 1.0,
    fps: int = 25,
    width: int = 720,
    window: tuple[float, float] | None = None,
    progress: bool = True,
    force: bool = False,
) -> Path:
    """Write a run as a film: the drum, bundles in colors, and the power as it goes.

    Parameters
    ----------
    run
        A finished run, one that ended unstable, or what was recorded of a run.
    path
        File to write, whole or not at all: its name ends in ``.mp4``, which needs the extra `movie`, ``.gif`` or
        ``.webp``.
    color
        What colors stand for: ``"speed"``, ``"species"``, or ``"height"``, where bundles were in the first picture, so
        that mixing shows.
    speed
        Simulated seconds in a second of the film.
    fps
        Pictures in a second, at most; there are no more than there are frames.
    width
        Width [pixels].
    window
        Start and end [s] of what is shown; all unless given.
    progress
        Whether to show progress.
    force
        Whether to replace a file that is there.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ConfigError
        Where one of these is beyond its limits, a package is missing, or a file is there already.
    OSError
        Where the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import drumrs
    >>> result = drumrs.run(drumrs.baseline(fill=0.1).replace({"run.duration": 0.1}), progress=False)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     drumrs.movie(result, Path(folder, "drum.gif"), width=300, progress=False).name
    'drum.gif'
    """
    path = Path(path)
    write = _writer(path)
    if path.is_dir() or (path.exists() and not force):
        hint = "choose another name, or replace it: --force, force=True in Python"
        raise ConfigError("the film", path, "a file that is not there yet", hint=hint)
    _check("speed", speed, 1e-6, 1e6)
    _check("fps", fps, 1, _MOST_RATE)
    _check("width", width, _LEAST_WIDTH, _MOST_WIDTH)
    frames = _within(run.frames, window)
    shown, rate = _schedule(frames.times, speed, fps)

    from drumrs.figures import Film

    film = Film(frames, run.series, run.config.title, color, width)
    _require_room(path, len(shown), film)
    with Task(f"film of {len(shown)} pictures", len(shown), "pictures", show=progress) as task:

        def pictures() -> Iterator[Picture]:
            for index in shown:
                yield film.picture(int(index))
                task.advance()

        with replacing(path) as temporary:
            write(temporary, pictures(), film, rate)
    return path


def _writer(path: Path) -> "Callable[[Path, Iterator[Picture], Film, float], None]":
    writers = {".mp4": _write_mp4, ".gif": _write_gif, ".webp": _write_webp}
    if path.suffix not in writers:
        raise ConfigError("the film", path, "a name that ends in .mp4, .gif or .webp")
    if path.suffix == ".mp4":
        # Asked for now, not after the first picture.
        _ffmpeg()
    return writers[path.suffix]


def _check(key: str, value: float, least: float, most: float) -> None:
    if not least <= value <= most:
        raise ConfigError(key, value, f"from {least:g} to {most:g}")


def _require_room(path: Path, pictures: int, film: "Film") -> None:
    """Refuse a film that its library would hold in memory as a whole, where that is too large."""
    size = 3 * math.prod(film.size) * pictures
    if path.suffix != ".mp4" and size > _MOST_MEMORY:
        limit = f"a film of at most {_MOST_MEMORY // 2**20} MiB of pictures: this one has {size // 2**20}"
        hint = "show a shorter part (--start, --end), fewer pictures (--fps), smaller ones (--width), or write an mp4"
        raise ConfigError("the film", path, limit, hint=hint)


def _within(frames: Frames, window: tuple[float, float] | None) -> Frames:
    """Return the frames of an interval."""
    if window is not None:
        frames = frames.picked(np.flatnonzero((frames.times >= window[0]) & (frames.times <= window[1])))
    if not len(frames):
        hint = "run.frame_every must be smaller than run.duration, and a window must hold frames"
        raise ConfigError("the run", problem="has no frames to show", hint=hint)
    return frames


def _schedule(times: NDArray[np.float64], speed: float, fps: int) -> tuple[NDArray[np.intp], float]:
    """Return which frame each picture shows, and pictures a second: no more than there are frames for it."""
    length = float(times[-1] - times[0])
    if not length:
        return np.zeros(1, np.intp), float(fps)
    rate = min(float(fps), speed * (len(times) - 1) / length)
    wanted = times[0] + speed / rate * np.arange(int(length * rate / speed + 1.5))
    after = np.clip(np.searchsorted(times, wanted), 1, len(times) - 1)
    return after - (wanted - times[after - 1] < times[after] - wanted), rate


def _write_mp4(path: Path, pictures: Iterator[Picture], film: "Film", rate: float) -> None:
    """Write with x264, in the colors that every player shows."""
    width, height = film.size
    read = ["-f", "rawvideo", "-pix_fmt", "rgba", "-s", f"{width}x{height}", "-r", f"{rate:.6g}", "-i", "-"]
    # An index at the front lets browsers begin at once; a temporary name does not tell the format.
    made = ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", _LOSS, "-movflags", "+faststart", "-f", "mp4"]
    command = [_ffmpeg(), "-y", "-loglevel", "error", *read, *made, str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as process:  # noqa: S603
        try:
            # Where ffmpeg cannot write it ends, and says why.
            with suppress(BrokenPipeError):
                for picture in pictures:
                    process.stdin.write(picture.data)  # type: ignore[union-attr]
            _, said = process.communicate()
        except BaseException:
            process.kill()
            raise
    if process.returncode:
        raise OSError(f"ffmpeg ended with: {said.decode(errors='replace').strip().rpartition(chr(10))[2]}")


def _ffmpeg() -> str:
    """Return the program ffmpeg: the wheel's, or what IMAGEIO_FFMPEG_EXE names."""
    what = "a film as .mp4"
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        return str(get_ffmpeg_exe())
    except ModuleNotFoundError as error:
        raise missing_package(what, error, "movie") from None
    except RuntimeError:
        problem = "needs ffmpeg, of which the package imageio-ffmpeg has none for this system"
        hint = "install ffmpeg, and name it in the variable IMAGEIO_FFMPEG_EXE"
        raise ConfigError(what, problem=problem, hint=hint) from None


def _write_gif(path: Path, pictures: Iterator[Picture], film: "Film", rate: float) -> None:
    from PIL import Image

    del film
    octree, plain = Image.Quantize.FASTOCTREE, Image.Dither.NONE
    images = (
        Image.fromarray(picture[..., :3]).quantize(_GIF_COLORS, octree, dither=plain) for picture in pictures
    )
    _save(path, "GIF", images, rate)


def _write_webp(path: Path, pictures: Iterator[Picture], film: "Film", rate: float) -> None:
    from PIL import Image

    del film
    _save(path, "WEBP", (Image.fromarray(picture[..., :3]) for picture in pictures), rate)


def _save(path: Path, kind: str, images: "Iterator[Image]", rate: float) -> None:
    """Write images as one file that begins anew at its end."""
    # A file that Pillow opens stays open after Ctrl-C.
    with path.open("wb+") as file:
        next(images).save(file, kind, save_all=True, append_images=images, duration=1000.0 / rate, loop=0)
