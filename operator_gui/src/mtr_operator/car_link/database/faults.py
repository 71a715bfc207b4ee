"""Converts exceptions of the library for CAN databases to sentences about the file."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re

from .car_database import printable

# Maximum length of a quoted sentence of the library, in characters.
_MAX_SAID = 300
# Kinds of databases for which the library's exception has a reason each.
_KINDS = ("ARXML", "DBC", "KCD", "SYM", "CDD")
_WITHOUT_MUX = "a message is multiplexed, and a part of it has no line Mux"
_NO_NUMBER = re.compile(
    r"(?:invalid literal for int\(\) with base \d+|could not convert string to float): ['\"](.*)['\"]", re.DOTALL)
_INCOMPLETE = "a required part is missing or is not a number"
# Terms of Python about its own objects.
_INTERNAL = re.compile(r"\b(?:object|instances|unpack|NoneType|arguments?|<class)\b|^$")


def one_line(error: Exception) -> str:
    """Return the text of a library's exception on one line, printable, shortened and without a full stop."""
    return printable(" ".join((getattr(error, "strerror", None) or _reason(error)).split()).rstrip(".")[:_MAX_SAID])


def cause(error: Exception) -> Exception:
    """Return the exception of the library's reader for the kind of the file."""
    found = (getattr(error, f"e_{kind.lower()}", None) for kind in _KINDS)
    return next((each for each in found if isinstance(each, Exception)), error)


def in_words(kind: str, error: Exception) -> str:
    """Return the fault of the file, also if the text of the exception states only an internal detail."""
    if isinstance(error, RecursionError):
        return "it is nested too deeply"
    if type(error) is not KeyError:
        number = _NO_NUMBER.search(str(error))
        if number is not None:
            return f'"{number[1]}" is not a number'
        return _INCOMPLETE if _INTERNAL.search(str(error)) and not hasattr(error, "line") else str(error)
    name = str(error.args[0]) if error.args else ""
    if kind != "SYM" or not name:
        return name if " " in name else f"{name or 'a part'} is missing"
    return _WITHOUT_MUX if name == "Mux" else f"the signal {name} has no definition"


def _reason(error: Exception) -> str:
    """Text of an exception, with the reason of each kind that the library tried if it could read none."""
    causes = [(kind, getattr(error, f"e_{kind.lower()}", None)) for kind in _KINDS]
    stated = [f'{kind}: "{in_words(kind, each)}"' for kind, each in causes if each is not None]
    return ", ".join(stated) or str(error)
