"""Parameters of a node: frozen dataclasses whose numbers have a unit and a range, read from plain values."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
from dataclasses import dataclass
from typing import Any, ClassVar, Dict, Iterator, Mapping, Tuple, Type, TypeVar, get_type_hints

from .errors import ConfigurationError, check_range, figure

P = TypeVar("P", bound="ParameterSet")
LIMITS = "limits"


@dataclass(frozen=True)
class Limits:
    """Allowed range of a number, ends included, and its unit."""

    low: float
    high: float
    unit: str

    def __str__(self) -> str:
        return f"{figure(self.low)} to {figure(self.high)} {self.unit}".rstrip()


def number(default: float, low: float, high: float, unit: str = "") -> Any:
    """Return a field of a ParameterSet with default, allowed range and unit; the annotation may be float or int."""
    return dataclasses.field(default=default, metadata={LIMITS: Limits(low, high, unit)})


@dataclass(frozen=True)
class ParameterSet:
    """Base of the frozen dataclasses; construction raises ConfigurationError for the first number out of range.

    A field may be another ParameterSet; its names are on the same level as the others.
    """

    PREFIX: ClassVar[str] = ""  # prefix of the names in sentences

    def __post_init__(self) -> None:
        for item in dataclasses.fields(self):
            limits = item.metadata.get(LIMITS)
            if limits:
                check_range(self.PREFIX + item.name, getattr(self, item.name), limits.low, limits.high, limits.unit)


def parameters_from(values: Mapping[str, Any], kind: Type[P]) -> P:
    """Return the parameters with the given values, or their defaults; ConfigurationError for a wrong name or value."""
    known = sorted(_names(kind))
    for name in values:
        if name not in known:
            raise ConfigurationError(f"Parameter {name} is unknown; allowed are {', '.join(known)}.")
    return _made(values, kind)


def described(parameters: ParameterSet) -> str:
    """Return all values in one line, with units."""
    return ", ".join(f"{item.name} {_shown(value)} {item.metadata[LIMITS].unit}".rstrip() if LIMITS in item.metadata
                     else f"{item.name} {_shown(value)}" for item, value in _leaves(parameters))


def _names(kind: type) -> Iterator[str]:
    for name, hint in _hints(kind).items():
        if _is_set(hint):
            yield from _names(hint)
        else:
            yield name


def _leaves(parameters: ParameterSet) -> Iterator[Tuple[Any, Any]]:
    for item in dataclasses.fields(parameters):
        value = getattr(parameters, item.name)
        if isinstance(value, ParameterSet):
            yield from _leaves(value)
        else:
            yield item, value


def _hints(kind: type) -> Dict[str, Any]:
    hints = get_type_hints(kind)
    return {item.name: hints[item.name] for item in dataclasses.fields(kind)}


def _is_set(hint: Any) -> bool:
    return isinstance(hint, type) and issubclass(hint, ParameterSet)


def _made(values: Mapping[str, Any], kind: Type[P]) -> P:
    given = {}
    hints = _hints(kind)
    for item in dataclasses.fields(kind):
        if _is_set(hints[item.name]):
            given[item.name] = _made(values, hints[item.name])
        elif item.name in values:
            given[item.name] = _checked(item, hints[item.name], values[item.name])
    return kind(**given)


# Description of each type for a user, and the types of its values.
_KINDS = {float: ("a number", (int, float)), int: ("a whole number", (int,)), bool: ("true or false", (bool,)),
          str: ("a text", (str,)), Tuple[int, ...]: ("a list of whole numbers", (int,)),
          Tuple[float, ...]: ("a list of numbers", (int, float)), Tuple[str, ...]: ("a list of texts", (str,))}
_LISTS = (Tuple[int, ...], Tuple[float, ...], Tuple[str, ...])


def _checked(item: Any, hint: Any, value: Any) -> Any:
    """Return the value converted to the type of its field."""
    allowed, kinds = _KINDS[hint]
    if hint in _LISTS:
        right = isinstance(value, (list, tuple)) and all(_is_one_of(each, kinds) for each in value)
        convert = tuple
    else:
        right, convert = _is_one_of(value, kinds), hint
    if not right:
        limits = f", {item.metadata[LIMITS]}" if LIMITS in item.metadata else ""
        raise ConfigurationError(f"Parameter {item.name} is {value!r}; allowed is {allowed}{limits}.")
    return convert(value)


def _is_one_of(value: Any, kinds: Tuple[type, ...]) -> bool:
    # Python treats True as an integer; for a user it is not a number.
    return isinstance(value, kinds) and (bool in kinds or not isinstance(value, bool))


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return f"[{', '.join(_shown(each) for each in value)}]"
    return figure(value) if isinstance(value, (int, float)) else f"'{value}'"
