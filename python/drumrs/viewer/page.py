"""`Player`: a run's page, for a file, a notebook or as a part of a larger page."""

import html
import json
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from drumrs.config import Config
from drumrs.errors import ConfigError
from drumrs.files import write_whole
from drumrs.frames import Frames
from drumrs.viewer.bundle import module
from drumrs.viewer.recording import pack

if TYPE_CHECKING:
    import polars as pl

_NOTEBOOK_HEIGHT = 700  # CSS pixels

_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="drumrs">
<meta name="color-scheme" content="light dark">
<title>{title}</title>
<style>
body {{ max-width: 1240px; margin: 0 auto; padding: 12px; background: Canvas; }}
@media (max-width: 500px) {{ body {{ padding: 0; }} }}
</style>
</head>
<body>
{player}
{script}
</body>
</html>
"""


class Player:
    """A run as a page with its own player: no server, no library, nothing loaded from elsewhere.

    Parameters
    ----------
    frames
        Frames of the run.
    series
        Table of the run, one row a sample, for power and energies; without it the curves come from the frames.
    title
        Written over the player.
    window
        Interval of the averages [s], shaded in the curves.
    facts
        Written below the title.
    config
        The run's configuration, whose contact laws give the forces at contacts; they are not shown without it.
    discs
        ``result.discs``, for colors by energy received and by landings.

    Raises
    ------
    ConfigError
        Where there is no frame to show.

    Attributes
    ----------
    title
        What is written over the player.
    window
        Interval of the averages [s], `None` where there is none.
    facts
        What is written below the title.

    Examples
    --------
    >>> import drumrs
    >>> simulation = drumrs.Simulation(drumrs.baseline(fill=0.1))
    >>> simulation.run(duration=0.1)
    >>> from drumrs.viewer import Player
    >>> Player(simulation.frames, title="The first tenth of a second")
    <Player of 40 bundles, 3 frames>
    """

    def __init__(  # noqa: PLR0913 - what a page shows of a run
        self,
        frames: Frames,
        series: "pl.DataFrame | None" = None,
        *,
        title: str = "",
        window: tuple[float, float] | None = None,
        facts: str = "",
        config: Config | None = None,
        discs: "pl.DataFrame | None" = None,
    ) -> None:
        if not len(frames) or not frames.count:
            problem = (
                f"has {len(frames)} frames of {frames.count} bundles, but must have at least one to be shown"
            )
            raise ConfigError("the run", problem=problem)
        self._frames = frames
        self._series = series
        self._config = config
        self._discs = discs
        self.title = title
        self.window = window
        self.facts = facts

    @classmethod
    def of(
        cls,
        config: Config,
        frames: Frames,
        series: "pl.DataFrame | None" = None,
        note: str = "",
        discs: "pl.DataFrame | None" = None,
    ) -> Self:
        """Return the player of a run, with a title that says what was simulated.

        Parameters
        ----------
        config
            The configuration.
        frames, series
            What was recorded. Number of bundles and fill are those of the frames: a given start may have others than
            the configuration.
        note
            Added to the title.
        discs
            ``result.discs``, where it was recorded.
        """
        fill = config.drum.fill_of(frames.radii)
        title = config.title_of(Counter(frames.species) or frames.count, fill)
        return cls(
            frames,
            series,
            title=f"{title}: {note}" if note else title,
            window=config.run.averaging_window,
            facts=_facts(config, fill),
            config=config,
            discs=discs,
        )

    def __repr__(self) -> str:
        """Say what would be shown."""
        return f"<Player of {self._frames.count} bundles, {len(self._frames)} frames>"

    def recording(self) -> dict[str, Any]:
        """Return what a page reads, ready for JSON: `unpack` of recording.js makes a recording of it."""
        return pack(
            self._frames, self._series, self.title, self.window, self.facts, self._config, self._discs
        )

    def element(self, *, autoplay: bool = False, start: float | None = None) -> str:
        """Return the player as an HTML element; the page needs `script` once, anywhere.

        Parameters
        ----------
        autoplay
            Whether to play at once, unless the reader's system asks for less motion.
        start
            Time to show first [s]; the first frame unless given.
        """
        data = json.dumps(self.recording(), allow_nan=False)
        # A title may hold any text, but none that would end the script.
        safe = data.replace("<", "\\u003c")
        attributes = " autoplay" if autoplay else ""
        if start is not None:
            attributes += f' start="{start:g}"'
        return f'<drumrs-player{attributes}><script type="application/json">{safe}</script></drumrs-player>'

    def page(self, *, autoplay: bool = True) -> str:
        """Return the player as a whole HTML page."""
        return _PAGE.format(
            title=html.escape(self.title or "drumrs"),
            player=self.element(autoplay=autoplay),
            script=script(),
        )

    def save(self, path: str | Path) -> Path:
        """Write the page as one file, which any current browser opens without a server.

        Raises
        ------
        OSError
            Where the file cannot be written.
        """
        write_whole(path, self.page().encode())
        return Path(path)

    def _repr_html_(self) -> str:
        """Show the player in a notebook, in a frame of its own, apart from the notebook's style and scripts."""
        page = html.escape(self.page(autoplay=False), quote=True)
        return (
            f'<iframe srcdoc="{page}" sandbox="allow-scripts" title="Player of a simulation" '
            f'style="width: 100%; height: {_NOTEBOOK_HEIGHT}px; border: 0;"></iframe>'
        )


def _facts(config: Config, fill: float) -> str:
    """Return the line that places a case among others, with the mass of a load that may have been given."""
    try:
        derived = config.derived
    except ConfigError:
        # The time step was chosen for a given load of other sizes.
        return ""
    return config.facts_line(replace(derived, load_mass=derived.load_mass * fill / config.fill))


def script() -> str:
    """Return the script that all players of a page share, as an HTML element.

    Examples
    --------
    >>> from drumrs.viewer import script
    >>> script().startswith('<script type="module">')
    True
    """
    return f'<script type="module">\n{module("element.js")}</script>'
