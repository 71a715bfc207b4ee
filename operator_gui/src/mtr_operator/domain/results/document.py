"""Records from the plain values of a file, each value of the kind that its field declares."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import enum
import functools
from typing import Any, Mapping, Optional, Tuple, TypeVar, Union, get_args, get_origin, get_type_hints

Record = TypeVar("Record")
# Ids have 64 bits.
_LARGEST = 2 ** 64
# The longest sentence of a robot with all its causes has some hundred characters.
MAX_TEXT = 2000
_REPLACEMENT = "\N{REPLACEMENT CHARACTER}"
# Python 3.9 cannot evaluate "float | None", and read_record has to.
OptionalFloat = Optional[float]
OptionalInt = Optional[int]
Texts = Tuple[str, ...]
Floats = Tuple[float, ...]


def read_record(record_type: type[Record], document: Mapping[str, Any]) -> Record:
    """Record of a dataclass whose fields are numbers, texts, lists of either and enumerations, or None where they are
    optional.

    A field with a default may be missing. What does not fit raises KeyError, TypeError or ValueError.
    """
    if not isinstance(document, Mapping):
        raise TypeError("no table of names and values")
    kinds = kinds_of(record_type)  # type: ignore[arg-type]  # a class is hashable, which mypy does not see here
    values = {}
    for field in dataclasses.fields(record_type):  # type: ignore[arg-type]  # typeshed knows no type[dataclass]
        if field.name in document or field.default is dataclasses.MISSING:
            values[field.name] = _value(kinds[field.name], document[field.name])
    return record_type(**values)


@functools.lru_cache(maxsize=64)
def kinds_of(record_type: type[Any]) -> Mapping[str, Any]:
    """Kinds of a dataclass' fields; to evaluate them takes longer than to read the record."""
    return get_type_hints(record_type)


def plain(value: Any) -> Any:
    """Value for a file."""
    if isinstance(value, tuple):
        return list(value)
    return value.value if isinstance(value, enum.Enum) else value


def shown_text(text: str) -> str:
    """A text of a file on one line, as pictures, pages and terminals can show it: at most MAX_TEXT characters.

    Control characters, marks of direction and halves of characters become U+FFFD.
    """
    cut = text if len(text) <= MAX_TEXT else f"{text[:MAX_TEXT]}..."
    return cut if cut.isprintable() else "".join(
        letter if letter.isprintable() else " " if letter.isspace() else _REPLACEMENT for letter in cut)


def with_shown_texts(record: Record) -> Record:
    """The record with all its texts as shown_text() has them."""
    changes: dict[str, Any] = {}
    for field in dataclasses.fields(record):  # type: ignore[arg-type]  # typeshed knows no dataclass instance
        value = getattr(record, field.name)
        if type(value) is str and shown_text(value) != value:
            changes[field.name] = shown_text(value)
        elif isinstance(value, tuple) and value and all(type(each) is str for each in value):
            changes[field.name] = tuple(map(shown_text, value))
    return dataclasses.replace(record, **changes) if changes else record  # type: ignore[type-var]


def _value(kind: Any, value: Any) -> Any:
    kinds = get_args(kind) if get_origin(kind) is Union else (kind,)
    if value is None and type(None) in kinds:
        return None
    kind = kinds[0]
    if kind is Texts:
        return _texts(value)
    if kind is Floats:
        return _floats(value)
    if issubclass(kind, enum.Enum):
        return kind(value)
    # JSON writes 2.0 as it is, but another program may have written 2.
    accepted = (int, float) if kind is float else kind
    if not isinstance(value, accepted) or (isinstance(value, bool) and kind is not bool):
        raise TypeError(f"no {kind.__name__}")
    # Also false for NaN; no number in a file comes near it.
    if kind in (int, float) and not -_LARGEST <= value <= _LARGEST:
        raise ValueError("a number without sense")
    return value


def _floats(value: Any) -> Floats:
    if not isinstance(value, (list, tuple)):
        raise TypeError("no list of numbers")
    return tuple(float(_value(float, number)) for number in value)


def _texts(value: Any) -> Texts:
    if not isinstance(value, (list, tuple)) or not all(isinstance(text, str) for text in value):
        raise TypeError("no list of texts")
    return tuple(value)
