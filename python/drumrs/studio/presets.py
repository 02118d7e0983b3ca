"""Machines to begin with: the paper's drum, and the templates of `drumrs init`."""

from importlib.resources import files

from drumrs.config import Config, baseline
from drumrs.errors import ConfigError

BASELINE = "baseline"
# Machines that are not looked at as washers are.
_TRADES = {"dryer": "dryer", "ball-mill": "mill", "sag-mill": "mill", "coater": "coater", "mixer": "coater"}
_TEMPLATES = files("drumrs") / "templates"


def presets() -> dict[str, str]:
    """Return the names of the presets, each with a line that says what it is.

    Examples
    --------
    >>> from drumrs.studio.presets import presets
    >>> list(presets())[:3]
    ['baseline', 'ball-mill', 'coater']
    """
    found = {BASELINE: "The paper's drum, with three baffles"}
    for each in sorted(_TEMPLATES.iterdir(), key=lambda each: each.name):
        heading, _, _ = each.joinpath("README.md").read_text(encoding="utf-8").partition("\n")
        found[each.name] = heading.removeprefix("# ")
    return found


def trade_of(name: str) -> str:
    """Return the trade that a machine is of, a key of `TRADES`; the washer's for cases of one's own.

    Examples
    --------
    >>> from drumrs.studio.presets import trade_of
    >>> trade_of("sag-mill")
    'mill'
    """
    return _TRADES.get(name, "washer")


def preset(name: str) -> Config:
    """Return the configuration of a preset.

    Raises
    ------
    ConfigError
        Where there is none of this name.
    """
    if name not in presets():
        raise ConfigError("preset", name, f"one of {', '.join(presets())}")
    if name == BASELINE:
        return baseline(baffles=True)
    return Config.from_toml(_TEMPLATES.joinpath(name, "case.toml").read_text(encoding="utf-8"))
