"""The studio: a page on which a drum turns while it is changed.

`session` runs a simulation in a thread, `scene` and `measures` say what is shown of it, `controls` what can be changed,
`responder` answers the page; `server` brings it to a browser, `notebook` to a notebook. The page is studio.js of
`viewer`, made of the parts that the player is made of.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from drumrs.config import Config, require_config
from drumrs.studio.presets import BASELINE, preset
from drumrs.studio.session import Session

if TYPE_CHECKING:
    from drumrs.studio.notebook import StudioWidget

__all__ = ["Session", "widget"]


def widget(
    config: Config | str | Path | None = None, seed: int | None = None, *, threads: int = 1
) -> "StudioWidget":
    """Return the studio for a notebook: a drum that turns while it is changed, below the cell.

    It needs the extra: ``pip install 'drumrs[notebook]'``.

    Parameters
    ----------
    config
        What to simulate: a configuration, or the name of a file that is laid over the baseline, as `Config.read`; the
        paper's drum with baffles unless given.
    seed
        Seed of the random start, instead of ``config.run.seed``.
    threads
        Threads that share a step; nothing depends on their number but how fast it goes.

    Returns
    -------
    StudioWidget
        The widget. Its ``session`` is the `Session` that is shown: ``session.case()`` is the configuration of which it
        is the run, ``session.series()`` what was recorded. ``close`` ends it.

    Raises
    ------
    ConfigError
        Where no such simulation can be, or the extra is missing.

    Examples
    --------
    >>> import drumrs
    >>> studio = drumrs.widget(drumrs.baseline(fill=0.1), seed=2)
    >>> studio
    <StudioWidget of 40 bundles (10 % fill), no baffles, 54 rpm, seed 2>
    >>> studio.session.case() == drumrs.baseline(fill=0.1).replace({"run.seed": 2})
    True
    >>> studio.close()
    """
    from drumrs.studio.notebook import StudioWidget

    name = BASELINE if config is None else "your case"
    if isinstance(config, (str, Path)):
        name, config = Path(config).name, Config.read(config)
    config = preset(BASELINE) if config is None else require_config(config)
    if seed is not None:
        config = config.replace({"run.seed": seed})
    return StudioWidget(Session(config, threads=threads), name)
