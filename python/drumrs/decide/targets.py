"""`Target`: what a decision is about, a quantity of a run or an arithmetic expression of several."""

import ast
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from drumrs.analysis import Estimate, Mean, estimate
from drumrs.decide.expression import Expression, Name
from drumrs.decide.readings import Readings, check, needs_frames, record_of
from drumrs.decide.readings import names as quantity_names
from drumrs.errors import ConfigError

if TYPE_CHECKING:
    from drumrs.config import Config
    from drumrs.result import Result


class Own(NamedTuple):
    """A measure of one's own: the function, what `run.record` must have, whether it needs frames."""

    measure: "Callable[[Result], Mean | float | None]"
    record: tuple[str, ...]
    needs_frames: bool

    def mean(self, result: "Result") -> Mean:
        """Return what the function gives for a run."""
        found = self.measure(result)
        return found if isinstance(found, Mean) else Mean(math.nan if found is None else float(found), None)


@dataclass(frozen=True)
class Target:
    """A quantity of a run, or an expression of several, with its statistical error.

    Made by `Target.parse`; called with a run it returns the `Estimate` of it.

    Attributes
    ----------
    text
        The expression as it was given.
    names
        The quantities in it, each over the window of the averages or in a phase.
    unit
        Unit; "1" for a plain number.
    own
        How a measure of your own is made, see `Target.of`; `None` of an expression.

    Examples
    --------
    >>> import drumrs
    >>> from drumrs.decide import Target
    >>> target = Target.parse("mean_drop / drum_specific_power")
    >>> target.label, target.records, target.needs_frames
    ('mean drop / drum specific power [m kg/W]', (), True)
    >>> result = drumrs.run(drumrs.baseline().replace({"run.duration": 0.5}), progress=False)
    >>> found = Target.parse("drum_specific_power")(result)
    >>> found.mean == result.summary.drum_specific_power
    True
    """

    text: str
    names: tuple[Name, ...]
    unit: str
    _expression: Expression = field(repr=False, compare=False)
    own: Own | None = None

    @classmethod
    def parse(cls, text: "str | Target") -> "Target":
        """Read a target.

        Parameters
        ----------
        text
            Name of a quantity that `drumrs quantities` lists, or an expression with ``+ - * / **``, parentheses,
            numbers, ``abs``, ``sqrt``, ``log`` and ``exp``. A quantity is that over the window of the averages;
            ``falls_per_turn[tumble]`` is that of the phase of this name, ``falls_per_turn[2]`` of the second phase,
            and ``falls_per_turn["main wash"]`` puts a name with spaces in quotes. What asks for arguments has them in
            parentheses, ``lacey_index(by='side', turns=2)``. A target is returned as it is.

        Raises
        ------
        ConfigError
            Where it is no such expression, a name is not that of a quantity, an argument is missing or not accepted, or
            units are added that differ.

        Examples
        --------
        >>> from drumrs.decide import Target
        >>> Target.parse("drum_power[spin] / drum_power[tumble]").unit
        '1'
        >>> try:
        ...     Target.parse("drop_height")
        ... except ValueError as error:
        ...     print(error)
        the target drop_height is not the name of a quantity; did you mean head_height?
        """
        if isinstance(text, Target):
            return text
        expression = Expression.parse(text)
        names = expression.names
        if not names:
            raise ConfigError("target", text, "of at least one quantity")
        return cls(text.strip(), names, expression.unit, expression)

    @classmethod
    def of(
        cls,
        name: str,
        measure: "Callable[[Result], Mean | float | None]",
        unit: str = "1",
        *,
        record: Sequence[str] = (),
        needs_frames: bool = False,
    ) -> "Target":
        """Make a target of a function, such as one of `drumrs.measures` with arguments of your own.

        Parameters
        ----------
        name
            What it is called, a name as variables of Python have.
        measure
            From a finished run to a number, with its error where it is a `Mean`; `None` where the run has none.
        unit
            Its unit.
        record
            What `run.record` must have for it.
        needs_frames
            Whether it is measured on frames.

        Raises
        ------
        ConfigError
            Where the name is none, or that of a quantity.

        Examples
        --------
        >>> import drumrs
        >>> from drumrs import measures
        >>> from drumrs.decide import Target
        >>> peak = Target.of("lift", lambda run: measures.peak_factor(run.series, "rim_force_y", (0.2, 0.5)))
        >>> result = drumrs.run(drumrs.baseline(fill=0.1).replace({"run.duration": 0.5}), progress=False)
        >>> peak(result).mean > 1.0
        True
        """
        if not name.isidentifier() or name in quantity_names():
            limit = "a name such as those of quantities, and not one of them"
            raise ConfigError("the name of a target", name, limit)
        own = Own(measure, tuple(record), needs_frames)
        return cls(name, (Name(name),), unit, Expression(ast.Name(name)), own)

    def __str__(self) -> str:
        """Return the expression as it was given."""
        return self.text

    @property
    def title(self) -> str:
        """The expression in words."""
        return (
            self.text.replace("_", " ").replace("[", " in ").translate({ord(mark): None for mark in "]'\""})
        )

    @property
    def label(self) -> str:
        """The expression in words with its unit, as it stands at an axis or at the head of a column."""
        return self.title if self.unit == "1" else f"{self.title} [{self.unit}]"

    @property
    def records(self) -> tuple[str, ...]:
        """What `run.record` of a run must have."""
        if self.own is not None:
            return self.own.record
        return tuple(dict.fromkeys(record for name in self.names for record in record_of(name.quantity)))

    @property
    def needs_frames(self) -> bool:
        """Whether it is measured on frames."""
        if self.own is not None:
            return self.own.needs_frames
        return any(needs_frames(name.quantity) for name in self.names)

    def check(self, config: "Config") -> None:
        """Refuse, before it is run, a configuration whose run will not have the target.

        Raises
        ------
        ConfigError
            Where it keeps too few frames, or has no such phase or part.
        """
        if self.needs_frames and not config.run.frame_every < config.run.duration:
            limit = f"smaller than run.duration = {config.run.duration}: {self} is measured on frames"
            raise ConfigError("run.frame_every", config.run.frame_every, limit)
        for name in self.names if self.own is None else ():
            check(config, *name)

    def mean(self, result: "Result | Readings") -> Mean:
        """Return the value of one run with its standard error, as its blocks tell.

        Where several quantities of one run come together, their errors are added, not their squares: they may move
        together, and no correlation makes more of them than that. Several seeds tell better, see `of_seeds`.

        Parameters
        ----------
        result
            A run, or the `Readings` of it, which several targets may share.

        Returns
        -------
        Mean
            The value is not a number where the run has none, as the drop of falls where nothing falls; the error is
            `None` where the run is too short to have one.

        Raises
        ------
        ConfigError
            Where the run has not recorded what the target needs, or has no such phase.
        """
        readings = result if isinstance(result, Readings) else Readings(result)
        if self.own is not None:
            return self.own.mean(readings.result)
        found = {name: readings.mean(*name) for name in self.names}
        values = {name: mean.value for name, mean in found.items()}
        return Mean(self._expression.value(values), self._error(found, values))

    def __call__(self, result: "Result") -> Estimate:
        """Return the estimate that one run gives; the arguments and errors are those of `mean`."""
        return self.of_seeds([self.mean(result)])

    def of_seeds(self, means: Sequence[Mean]) -> Estimate:
        """Return the estimate from runs that differ by their seeds, `drumrs.analysis.estimate`.

        The values of an expression tell by their scatter alone, which has the correlations within a run in it; those
        of a single quantity by the errors of their runs, too.

        Parameters
        ----------
        means
            What `mean` returns for each of them. Values that are no numbers are left out.

        Returns
        -------
        Estimate
            Not a number, with an infinite error, where no run has a value.
        """
        there = [mean for mean in means if math.isfinite(mean.value)]
        if not there:
            return Estimate(math.nan, math.inf, 1)
        by_scatter = len(self.names) > 1 and len(there) > 1
        return estimate(
            [mean.value for mean in there], None if by_scatter else [mean.error for mean in there]
        )

    def _error(self, found: Mapping[Name, Mean], values: Mapping[Name, float]) -> float | None:
        """Return by how much the value changes, at most, where every quantity is off by its error."""
        total = 0.0
        for name, mean in found.items():
            if mean.error is None:
                return None
            ends = [
                self._expression.value({**values, name: mean.value + sign * mean.error})
                for sign in (1.0, -1.0)
            ]
            total += abs(ends[0] - ends[1]) / 2.0
        return total if math.isfinite(total) else None
