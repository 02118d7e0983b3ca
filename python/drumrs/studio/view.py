"""`View`: what a session shows at a moment."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

from drumrs.studio.scene import pack_forces, pack_frame

if TYPE_CHECKING:
    from drumrs.config import Config
    from drumrs.frames import Frames


@dataclass(eq=False)
class View:
    """What a session shows: replaced whole by the session's thread, never changed.

    Attributes
    ----------
    start
        Number of the start: it grows with every reset.
    config
        With what a reset would start.
    title, facts
        Lines that tell this case from others and place it among them, at its present speed.
    scene
        Drum, load and title, as `unpack` of recording.js reads them.
    now
        What is to be seen: the frame of this moment.
    spin
        Angular velocity of the drum [rad/s].
    factor
        Simulated seconds in a second.
    number
        Number of the picture.
    measures
        Tiles and curves, and "number", which grows; none at first.
    playing
        Whether the simulation goes on.
    rate
        Simulated seconds in a second that were asked for; infinite for as many as can be.
    speed
        Speed of the drum that was asked for last, or with which it started [rpm].
    trade
        Whose measures are made.
    said
        What has been said so far, the last sentence last.
    """

    start: int
    config: "Config"
    title: str
    facts: str
    scene: dict[str, Any]
    now: "Frames"
    spin: float
    factor: float
    number: int = 0
    measures: dict[str, Any] = field(default_factory=dict)
    playing: bool = True
    rate: float = 1.0
    speed: float = 0.0
    trade: str = ""
    said: tuple[str, ...] = ()

    @cached_property
    def frame(self) -> bytes:
        """The picture, as `pack_frame` makes it: once, where somebody wants it."""
        return pack_frame(self.now, self.scene["reach"], self.start, self.spin, self.factor)

    @cached_property
    def forces(self) -> bytes:
        """The forces at its contacts, as `pack_forces` makes them; they go behind the picture."""
        return pack_forces(self.config, self.now, self.measures.get("forceScale"))
