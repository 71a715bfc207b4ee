"""Reads CAN databases of all kinds that cantools supports; a faulty message does not affect the others."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import codecs
import logging
import pathlib
from typing import Any

import cantools

from mtr_operator.domain.errors import ConnectionFailed

from ..further.sizes import size_words, too_large
from .alone import Separated, kcd_messages, kcd_problem, with_kcd_lengths
from .arxml_alone import arxml_messages
from .car_database import CarDatabase, Problems
from .dbc_lines import dbc_messages
from .dbc_messages import built, problems
from .dbc_statements import without_texts
from .faults import one_line
from .repeated import contradictions, join_pages
from .sym_alone import sym_messages
from .sym_expansion import expansion
from .sym_text import sym_problems

# Databases of a whole car have some megabytes; the library needs ten seconds or more for one.
_MAX_DATABASE_BYTES = 16 * 1024 * 1024
_DBC, _KCD, _SYM = ".dbc", ".kcd", ".sym"
# Exceptions with readable texts, and the text for all others.
_READABLE = (OSError, UnicodeError, cantools.database.errors.Error)
_DAMAGED = "it is damaged"
# Kinds whose messages can be read one by one.
_ALONE = {_KCD: kcd_messages, _SYM: sym_messages, ".arxml": arxml_messages}
_MARKS = {codecs.BOM_UTF8: "utf-8-sig", codecs.BOM_UTF16_LE: "utf-16", codecs.BOM_UTF16_BE: "utf-16"}

# The library logs foreign message names of any length. Every program that reads such a database imports this module,
# and contradictions that matter to a profile are refused with a sentence.
logging.getLogger("cantools").addHandler(logging.NullHandler())
logging.getLogger("cantools").propagate = False


def load_database(path: pathlib.Path) -> CarDatabase:
    """Read a database; ConnectionFailed states why it is unreadable. A database of a kind other than CAN has no
    message."""
    try:
        if path.stat().st_size > _MAX_DATABASE_BYTES:
            raise ConnectionFailed(f"CAN database {path} is larger than {_MAX_DATABASE_BYTES // 1024} KiB; "
                                   "leave the messages that the profile does not name out of it.")
        text = decoded_text(path.read_bytes(), path.suffix)
        size = too_large(without_texts(text) if path.suffix.lower() == _DBC else text, path.suffix)
        # The library allocates memory for each bit. Messages of an ARXML file have no separate part in it.
        return _parsed(path, text, f"CAN database {path} cannot be read: {size_words(size)}." if size else "")
    except _READABLE as error:
        raise ConnectionFailed(f"CAN database {path} cannot be read: {one_line(error)}.") from None
    # The library's readers of some five formats raise various exceptions for damaged files.
    except (ValueError, TypeError, AttributeError, LookupError, ArithmeticError, RecursionError):
        raise ConnectionFailed(f"CAN database {path} cannot be read: {_DAMAGED}.") from None


def decoded_text(data: bytes, suffix: str) -> str:
    """Decode a database: by its byte order mark, else as UTF-8, else in the encoding of Windows, as every SYM file."""
    encoding = next((name for mark, name in _MARKS.items() if data.startswith(mark)), "") or _unmarked(data[:2])
    encoding = encoding or ("cp1252" if suffix.lower() == _SYM else "utf-8")
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError:
        text = data.decode("cp1252", errors="replace")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _unmarked(begin: bytes) -> str:
    """Return the UTF-16 byte order without a mark, detected by the zero next to the first letter."""
    return "utf-16-le" if begin[1:] == b"\0" else "utf-16-be" if begin[:1] == b"\0" else ""


def _parsed(path: pathlib.Path, text: str, refusal: str) -> CarDatabase:
    """Parse a text. refusal: sentence why the library must not read it as a whole."""
    if path.suffix.lower() != _DBC:
        return _parsed_other(path, text, refusal)
    lines = dbc_messages(text)
    try:
        messages, reason = _messages(_loaded(path, text, refusal)), ""
    # The library refuses a file as a whole, with various exceptions; then the usable messages count.
    except Exception as error:
        # Without one complete line BO_, the library's sentence is more specific.
        if all(line.problem for line in lines) and not refusal:
            raise
        messages, reason = built(lines), one_line(error) if isinstance(error, _READABLE) else _DAMAGED
    return CarDatabase(path, messages, problems(lines, messages), "" if refusal else reason)


def _parsed_other(path: pathlib.Path, text: str, refusal: str) -> CarDatabase:
    """Parse a kind other than DBC; after a refusal of the library, its messages one by one."""
    suffix, separated = path.suffix.lower(), Separated()
    text = with_kcd_lengths(text) if suffix == _KCD else text
    if not refusal:
        problem = kcd_problem(text) if suffix == _KCD else expansion(text).problem() if suffix == _SYM else ""
        refusal = f"CAN database {path} cannot be read: {problem}." if problem else ""
    try:
        messages = _messages(_loaded(path, text, refusal))
    # The same applies as to a DBC file.
    except Exception:
        found = None if refusal and suffix not in (_KCD, _SYM) else _separated(suffix, text)
        if found is None or not (found.messages or found.faults):
            raise
        separated, messages = found, found.messages
    join_pages(messages)
    repeated_messages, repeated_signals = contradictions(messages)
    problems_found = Problems(messages={**repeated_messages, **separated.faults}, signals=repeated_signals)
    if suffix == _SYM:
        sym_problems(text, messages, problems_found)
    return CarDatabase(path, messages, problems_found, unread=separated.unread)


def _loaded(path: pathlib.Path, text: str, refusal: str) -> Any:
    """Return the library's database. ConnectionFailed states the refusal, if any."""
    if refusal:
        raise ConnectionFailed(refusal)
    suffix = path.suffix.lower()
    if suffix == _DBC or suffix in _ALONE:
        return cantools.database.load_string(text, suffix[1:], strict=False)
    return cantools.database.load_file(str(path), strict=False)


def _separated(suffix: str, text: str) -> Separated | None:
    """Return the messages of a file that the library refuses; None if not even one can be read alone."""
    try:
        return _ALONE[suffix](text) if suffix in _ALONE else None
    # The reason for refusing the whole file is more specific.
    except Exception:
        return None


def _messages(database: Any) -> list[Any]:
    return list(database.messages) if isinstance(database, cantools.database.can.Database) else []
