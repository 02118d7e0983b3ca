"""The part of a simulation that lets its drum change to another speed under way."""

import math
import numbers
import threading
from typing import Any

from drumrs.config import Config
from drumrs.config.program import with_speed
from drumrs.errors import ConfigError, DrumrsError
from drumrs.records import Records


class HasSpeed:
    """A simulation whose drum may change its speed."""

    _config: Config
    # The compiled core, which few modules import.
    _core: Any
    _records: Records
    _running: threading.Lock

    def set_speed(self, rpm: float, ramp: float = 0.1) -> float:
        """Let the drum change to another speed as soon as it can, and stay there, whatever its program was.

        The change becomes part of the configuration: `config` is that of a run which is the same as this one from its
        start on, bit for bit. The time step stays what it is.

        Parameters
        ----------
        rpm
            The new speed [rpm].
        ramp
            Time in which the speed changes evenly [s].

        Returns
        -------
        float
            When the change begins [s]: within a millisecond or few steps, or where the ramp ends that the drum is on.

        Raises
        ------
        ConfigError
            Where the drum cannot have this speed; the simulation stays as it was.
        DrumrsError
            Where another thread is running this simulation.

        Examples
        --------
        >>> import drumrs
        >>> simulation = drumrs.Simulation(drumrs.baseline(fill=0.1), seed=1)
        >>> simulation.run(steps=100)
        >>> simulation.set_speed(60.0)
        0.001
        >>> simulation.config.rotation.program
        ((0.0, 54.0), (0.001, 54.0), (0.101, 60.0))
        """
        if not (isinstance(ramp, numbers.Real) and 0.0 < ramp < math.inf):
            raise ConfigError("ramp", ramp, "a positive finite time")
        if not self._running.acquire(blocking=False):
            raise DrumrsError(
                "this simulation is being run, and its speed cannot be set meanwhile: stop it first"
            )
        try:
            # The step after the next one is the first of which nothing is known yet.
            earliest = math.ceil(1e3 * (self._core.time + 3.0 * self._core.time_step)) / 1e3
            knots = with_speed(self._config.rotation.knots, rpm, earliest, ramp)
            changes = {"rotation.program": knots, "run.time_step": self._core.time_step}
            config = self._config.replace(changes)
            core = self._core.with_config(config.to_core_json())
            self._config, self._core = config, core
            self._records = Records(core, config, self._records.columns)
        finally:
            self._running.release()
        begin, _ = knots[-2]
        return begin
