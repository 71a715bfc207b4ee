"""Reads CAN databases of any kind that cantools reads; of a DBC what is wrong with one message costs no other."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import codecs
import logging
import pathlib
from typing import Any

import cantools

from mtr_operator.domain.errors import ConnectionFailed

from ..further.sizes import MAX_SIZE, too_large
from .car_database import CarDatabase, Problems, printable
from .dbc_lines import dbc_messages
from .dbc_messages import built, problems
from .repeated import contradictions, join_pages
from .sym_text import sym_problems

# Databases of a whole car have some megabytes; reading one takes the library ten seconds and more.
_MAX_DATABASE_BYTES = 16 * 1024 * 1024
# Of a library's sentence, characters.
_MAX_SAID = 300
_DBC, _SYM = ".dbc", ".sym"
# Exceptions whose texts a person understands, and what is said of all others.
_READABLE = (OSError, UnicodeError, cantools.database.errors.Error)
_DAMAGED = "it is damaged"
# Kinds of databases, as the library names the reason of each.
_KINDS = ("ARXML", "DBC", "KCD", "SYM", "CDD")
_WITHOUT_MUX = "a message is multiplexed, and a part of it has no line Mux"
_MARKS = {codecs.BOM_UTF8: "utf-8-sig", codecs.BOM_UTF16_LE: "utf-16", codecs.BOM_UTF16_BE: "utf-16"}

# The library logs names of messages as a stranger wrote them, of any length. Every program that reads such a database
# imports this module, and contradictions that matter to a profile are refused with a sentence.
logging.getLogger("cantools").addHandler(logging.NullHandler())
logging.getLogger("cantools").propagate = False


def load_database(path: pathlib.Path) -> CarDatabase:
    """Read a database; ConnectionFailed states why it is unreadable. One of another kind than CAN has no message."""
    try:
        if path.stat().st_size > _MAX_DATABASE_BYTES:
            raise ConnectionFailed(f"CAN database {path} is larger than {_MAX_DATABASE_BYTES // 1024} KiB; "
                                   "leave the messages that the profile does not name out of it.")
        text = decoded_text(path.read_bytes())
        size = too_large(text, path.suffix)
        if size:
            raise ConnectionFailed(f"CAN database {path} cannot be read: it says {size} where a place or a size of a "
                                   f"message or signal stands; allowed is up to {MAX_SIZE}.")
        return _parsed(path, text)
    except _READABLE as error:
        raise ConnectionFailed(f"CAN database {path} cannot be read: {one_line(error)}.") from None
    # The library's readers of some five formats raise whatever a damaged file leads them to.
    except (ValueError, TypeError, AttributeError, LookupError, ArithmeticError, RecursionError):
        raise ConnectionFailed(f"CAN database {path} cannot be read: {_DAMAGED}.") from None


def decoded_text(data: bytes) -> str:
    """Text of a database or log: by the mark at its beginning, else UTF-8, else the encoding of Windows."""
    encoding = next((name for mark, name in _MARKS.items() if data.startswith(mark)), "utf-8")
    try:
        return data.decode(encoding)
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")


def one_line(error: Exception) -> str:
    """Return the text of a library's exception on one line, printable, shortened and without a full stop."""
    return printable(" ".join((getattr(error, "strerror", None) or _reason(error)).split()).rstrip(".")[:_MAX_SAID])


def _reason(error: Exception) -> str:
    """Text of an exception; of each kind that the library tried, when it could read none of them."""
    causes = [(kind, getattr(error, f"e_{kind.lower()}", None)) for kind in _KINDS]
    stated = [f'{kind}: "{_stated(kind, cause)}"' for kind, cause in causes if cause is not None]
    return ", ".join(stated) or str(error)


def _stated(kind: str, cause: Exception) -> str:
    """Return the fault of the file, also if the text of the exception states only an internal detail."""
    if isinstance(cause, RecursionError):
        return "it is nested too deeply"
    if type(cause) is not KeyError:
        return str(cause)
    name = str(cause.args[0]) if cause.args else ""
    if kind != "SYM" or not name:
        return name if " " in name else f"{name or 'a part'} is missing"
    return _WITHOUT_MUX if name == "Mux" else f"the signal {name} has no definition"


def _parsed(path: pathlib.Path, text: str) -> CarDatabase:
    if path.suffix.lower() != _DBC:
        messages = _messages(cantools.database.load_file(str(path), strict=False))
        join_pages(messages)
        repeated_messages, repeated_signals = contradictions(messages)
        found = Problems(messages=repeated_messages, signals=repeated_signals)
        if path.suffix.lower() == _SYM:
            # The library reads such a file in this encoding, and the names have to be the same.
            sym_problems(path.read_text(encoding="cp1252", errors="replace"), messages, found)
        return CarDatabase(path, messages, found)
    lines, refusal = dbc_messages(text), ""
    try:
        messages = _messages(cantools.database.load_file(str(path), strict=False))
    # The library refuses a file as a whole, by whatever exception; then the messages count that can be used.
    except Exception as error:
        # Of a file without one complete line BO_ the library's sentence says more.
        if all(line.problem for line in lines):
            raise
        messages, refusal = built(lines), one_line(error) if isinstance(error, _READABLE) else _DAMAGED
    return CarDatabase(path, messages, problems(lines, messages), refusal)


def _messages(database: Any) -> list[Any]:
    return list(database.messages) if isinstance(database, cantools.database.can.Database) else []
