"""Expressions of quantities: read from a text, refused where they are none, with their value and unit."""

import ast
import math
import operator
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple, Self, TypeGuard

from drumrs.decide.measured import Value
from drumrs.decide.readings import Arguments, bind, find
from drumrs.decide.units import PLAIN, Unit, format_unit, parse_unit, product
from drumrs.errors import ConfigError

_OPERATORS: Mapping[type[ast.AST], Callable[[float, float], float]] = MappingProxyType(
    {
        ast.Add: operator.add,
        ast.Sub: operator.sub,
        ast.Mult: operator.mul,
        ast.Div: operator.truediv,
        ast.Pow: math.pow,
    }
)
_FUNCTIONS: Mapping[str, Callable[[float], float]] = MappingProxyType(
    {"abs": abs, "sqrt": math.sqrt, "log": math.log, "exp": math.exp}
)
_LONGEST = 300
_ALLOWED = (
    "an expression of names of quantities, numbers, + - * / ** ( ), abs, sqrt, log and exp, a quantity in a phase "
    "as falls_per_turn[tumble], arguments as in lacey_index(by='side')"
)


class Name(NamedTuple):
    """A quantity, over the window or in a phase of the program, with its arguments where it takes some."""

    quantity: str
    phase: str | None = None
    arguments: Arguments = ()


@dataclass(frozen=True)
class Expression:
    """An arithmetic expression of quantities.

    Attributes
    ----------
    tree
        Its syntax.
    """

    tree: ast.expr

    @classmethod
    def parse(cls, text: str) -> Self:
        """Read an expression.

        Raises
        ------
        ConfigError
            Where the text is none, or a name in it is not that of a quantity.
        """
        if not isinstance(text, str) or len(text) > _LONGEST:
            raise ConfigError("target", text, _ALLOWED)
        try:
            tree = ast.parse(text.strip(), mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise ConfigError("target", text, _ALLOWED) from None
        for node in _nodes(tree):
            if not _is_allowed(node):
                piece = ast.get_source_segment(text.strip(), node)
                problem = f"has {piece} in it, but must be {_ALLOWED}"
                raise ConfigError(f"the target {text}", text, _ALLOWED, problem=problem)
        return cls(tree)

    @property
    def names(self) -> tuple[Name, ...]:
        """The quantities in it, each once."""
        found = map(_name, _nodes(self.tree))
        return tuple(dict.fromkeys(name for name in found if name is not None))

    @property
    def unit(self) -> str:
        """Its unit; "1" for a plain number.

        Raises
        ------
        ConfigError
            Where quantities of different units are added, or a function is of one that is no plain number.
        """
        return format_unit(_unit_of(self.tree))

    def value(self, values: Mapping[Name, float]) -> float:
        """Return its value for values of the quantities; not a number where it has none."""
        try:
            value = _value(self.tree, values)
        except (ArithmeticError, ValueError):
            return math.nan  # such as a ratio to a power that is 0
        return value if math.isfinite(value) else math.nan


def _nodes(node: ast.expr) -> Iterator[ast.expr]:
    """Give the node and all that are part of its value."""
    yield node
    for part in _operands(node):
        yield from _nodes(part)


def _operands(node: ast.expr) -> list[ast.expr]:
    if isinstance(node, ast.BinOp):
        return [node.left, node.right]
    if isinstance(node, ast.UnaryOp):
        return [node.operand]
    return node.args if _is_function(node) else []


def _is_allowed(node: ast.expr) -> bool:
    if isinstance(node, ast.BinOp):
        if isinstance(node.op, ast.Pow):
            return _exponent(node) is not None
        return type(node.op) in _OPERATORS
    if isinstance(node, ast.UnaryOp):
        return isinstance(node.op, (ast.USub, ast.UAdd))
    if _is_function(node):
        return len(node.args) == 1 and not node.keywords
    if isinstance(node, ast.Constant):
        return isinstance(node.value, (int, float)) and not isinstance(node.value, bool)
    return _name(node) is not None


def _is_function(node: ast.expr) -> TypeGuard[ast.Call]:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in _FUNCTIONS


def _function(node: ast.Call) -> str:
    name: str = node.func.id  # type: ignore[attr-defined]  # a name: `_is_function`
    return name


def _name(node: ast.expr) -> Name | None:
    """Return the quantity that a node names, with phase and arguments; `None` where it names none."""
    phase = None
    if isinstance(node, ast.Subscript):
        phase, node = _literal(node.slice), node.value
        if phase is None:
            return None
    of, given, named = (node.func, node.args, node.keywords) if isinstance(node, ast.Call) else (node, [], [])
    if not isinstance(of, ast.Name) or of.id in _FUNCTIONS:
        return None
    values = [value for one in given if (value := _literal(one)) is not None]
    by_name = {one.arg: value for one in named if one.arg and (value := _literal(one.value)) is not None}
    if (len(values), len(by_name)) != (len(given), len(named)):
        return None
    return Name(of.id, None if phase is None else str(phase), bind(of.id, values, by_name))


def _literal(node: ast.expr) -> Value | None:
    """Return a text, with or without quotes, or a number; `None` where it is neither."""
    if isinstance(node, ast.Name):
        return node.id
    value = node.value if isinstance(node, ast.Constant) else None
    return value if isinstance(value, (str, int, float)) and not isinstance(value, bool) else None


def _exponent(node: ast.BinOp) -> float | None:
    """Return an exponent, which must be a number, with or without a sign."""
    try:
        number = ast.literal_eval(node.right)
    except (ValueError, TypeError):
        return None
    return float(number) if isinstance(number, (int, float)) else None


def _value(node: ast.expr, values: Mapping[Name, float]) -> float:
    if isinstance(node, ast.Constant):
        return float(node.value)  # type: ignore[arg-type]  # a number: `_is_allowed`
    name = _name(node)
    if name is not None:
        return values[name]
    parts = [_value(part, values) for part in _operands(node)]
    if isinstance(node, ast.BinOp):
        return _OPERATORS[type(node.op)](parts[0], parts[1])
    if _is_function(node):
        return _FUNCTIONS[_function(node)](parts[0])
    return -parts[0] if isinstance(node.op, ast.USub) else parts[0]  # type: ignore[attr-defined]


def _unit_of(node: ast.expr) -> Unit:
    """Return the unit of a node.

    Raises
    ------
    ConfigError
        Where quantities of different units are added, or a function is of one that is no plain number.
    """
    name = _name(node)
    if name is not None:
        return parse_unit(find(name.quantity).unit)
    units = [_unit_of(part) for part in _operands(node)]
    if _is_function(node):
        return _unit_of_function(node, units[0])
    if not isinstance(node, ast.BinOp):
        return units[0] if units else PLAIN
    if isinstance(node.op, ast.Pow):
        return product(PLAIN, units[0], _exponent(node) or 0.0)
    if isinstance(node.op, (ast.Mult, ast.Div)):
        return product(units[0], units[1], 1.0 if isinstance(node.op, ast.Mult) else -1.0)
    if dict(units[0]) != dict(units[1]):
        one, other = (format_unit(unit) for unit in units)
        problem = f"adds {one} and {other}, but must add what has the same unit"
        hint = "divide each by what makes it a plain number"
        raise ConfigError(f"the target {ast.unparse(node)}", problem=problem, hint=hint)
    return units[0]


def _unit_of_function(node: ast.Call, unit: Unit) -> Unit:
    function = _function(node)
    if function == "abs":
        return unit
    if function == "sqrt":
        return product(PLAIN, unit, 0.5)
    if unit:
        problem = f"has {function} of a quantity in {format_unit(unit)}, but must have it of a plain number"
        raise ConfigError(f"the target {ast.unparse(node)}", problem=problem)
    return PLAIN
