"""What can go wrong, as four exceptions and two warnings; each message is one sentence with the value and the limit.

The core raises the same classes, by importing this module: so every error pickles, whichever side it comes from.
"""


class DrumrsError(Exception):
    """Base of every error that drumrs raises on purpose."""


class ConfigError(DrumrsError, ValueError):
    """A key, a value or a combination of them that no simulation can have.

    Examples
    --------
    >>> import drumrs
    >>> drumrs.baseline(fill=-0.1)
    Traceback (most recent call last):
    drumrs.errors.ConfigError: load.fill is -0.1, but must be a positive finite number
    """


class UnstableError(DrumrsError, RuntimeError):
    """The simulation left the range in which the model means anything; names the step and the bundle."""


class CheckpointError(DrumrsError, ValueError):
    """A checkpoint that is truncated, damaged or of another version."""


class DrumrsWarning(UserWarning):
    """Something that a configuration does and that its author may not expect; said at the start, with ways out."""


class PictureWarning(DrumrsWarning):
    """A picture, a player or a plot of a page that could not be made; names it, and why. The numbers are complete."""
