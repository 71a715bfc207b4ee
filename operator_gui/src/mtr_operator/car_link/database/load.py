"""Reads CAN databases of any kind that cantools reads; a faulty message costs no other one."""
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

# Databases of a whole car have some megabytes; reading one takes the library ten seconds and more.
_MAX_DATABASE_BYTES = 16 * 1024 * 1024
_DBC, _KCD, _SYM = ".dbc", ".kcd", ".sym"
# Exceptions whose texts a person understands, and what is said of all others.
_READABLE = (OSError, UnicodeError, cantools.database.errors.Error)
_DAMAGED = "it is damaged"
# Kinds of which messages can be read one by one.
_ALONE = {_KCD: kcd_messages, _SYM: sym_messages, ".arxml": arxml_messages}
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
        text = decoded_text(path.read_bytes(), path.suffix)
        size = too_large(without_texts(text) if path.suffix.lower() == _DBC else text, path.suffix)
        # The library uses memory for each bit. Messages of an ARXML have no part of it for themselves.
        return _parsed(path, text, f"CAN database {path} cannot be read: {size_words(size)}." if size else "")
    except _READABLE as error:
        raise ConnectionFailed(f"CAN database {path} cannot be read: {one_line(error)}.") from None
    # The library's readers of some five formats raise whatever a damaged file leads them to.
    except (ValueError, TypeError, AttributeError, LookupError, ArithmeticError, RecursionError):
        raise ConnectionFailed(f"CAN database {path} cannot be read: {_DAMAGED}.") from None


def decoded_text(data: bytes, suffix: str) -> str:
    """Text of a database: by the mark at its beginning, else UTF-8, else the encoding of Windows, as of every SYM."""
    encoding = next((name for mark, name in _MARKS.items() if data.startswith(mark)), "") or _unmarked(data[:2])
    encoding = encoding or ("cp1252" if suffix.lower() == _SYM else "utf-8")
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError:
        text = data.decode("cp1252", errors="replace")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _unmarked(begin: bytes) -> str:
    """UTF-16 without its mark, in which a zero is next to the first letter."""
    return "utf-16-le" if begin[1:] == b"\0" else "utf-16-be" if begin[:1] == b"\0" else ""


def _parsed(path: pathlib.Path, text: str, refusal: str) -> CarDatabase:
    """Read a text; refusal: why the library must not read it as a whole, as a sentence."""
    if path.suffix.lower() != _DBC:
        return _parsed_other(path, text, refusal)
    lines = dbc_messages(text)
    try:
        messages, reason = _messages(_loaded(path, text, refusal)), ""
    # The library refuses a file as a whole, by whatever exception; then the messages count that can be used.
    except Exception as error:
        # Of a file without one complete line BO_ the library's sentence says more.
        if all(line.problem for line in lines) and not refusal:
            raise
        messages, reason = built(lines), one_line(error) if isinstance(error, _READABLE) else _DAMAGED
    return CarDatabase(path, messages, problems(lines, messages), "" if refusal else reason)


def _parsed_other(path: pathlib.Path, text: str, refusal: str) -> CarDatabase:
    """Read another kind than DBC; after a refusal of the library, its messages one by one."""
    suffix, separated = path.suffix.lower(), Separated()
    text = with_kcd_lengths(text) if suffix == _KCD else text
    if not refusal:
        problem = kcd_problem(text) if suffix == _KCD else expansion(text).problem() if suffix == _SYM else ""
        refusal = f"CAN database {path} cannot be read: {problem}." if problem else ""
    try:
        messages = _messages(_loaded(path, text, refusal))
    # As of a DBC.
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
    """The library's database. ConnectionFailed states the refusal, if any."""
    if refusal:
        raise ConnectionFailed(refusal)
    suffix = path.suffix.lower()
    if suffix == _DBC or suffix in _ALONE:
        return cantools.database.load_string(text, suffix[1:], strict=False)
    return cantools.database.load_file(str(path), strict=False)


def _separated(suffix: str, text: str) -> Separated | None:
    """Messages of a file that the library refuses; None when not even one can be read alone."""
    try:
        return _ALONE[suffix](text) if suffix in _ALONE else None
    # The reason of the refusal of the whole file says more.
    except Exception:
        return None


def _messages(database: Any) -> list[Any]:
    return list(database.messages) if isinstance(database, cantools.database.can.Database) else []
