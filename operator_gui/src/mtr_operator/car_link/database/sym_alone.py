"""Messages of a SYM database one by one: each with the signals and tables of values that it uses."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import functools
import re
from typing import Any, Iterable, Iterator, Mapping, NamedTuple, Sequence

from .alone import MAX_MESSAGES, Separated, loaded_alone, max_characters
from .car_database import Unread
from .sym_expansion import IDENTIFIERS, MAX_REPEATED, expansion
from .sym_text import NAME, PART, SIGNALS, unquoted

_HEAD = re.compile(r"\s*(?://[^\n]*\n\s*)?FormatVersion\s*=\s*6\.0\s*//")
# The library ignores an incomplete statement at the end of a file; therefore a section without messages follows.
_FILE = ('FormatVersion=6.0 // Do not edit this line!\nTitle="x"\n\n{{ENUMS}}\n{}\n{{SIGNALS}}\n{}\n{}\n{}'
         "\n{{SENDRECEIVE}}\n")
_TABLE = "/e:"
_ENUMS, _MESSAGES = "{ENUMS}", ("{SEND}", "{RECEIVE}", "{SENDRECEIVE}")
_DEFINED = {SIGNALS: "Sig", _ENUMS: "Enum"}
# Beginnings of messages and identifiers in a text, also within an unterminated string.
_BEGINS = re.compile(r"^[ \t]*\[[ \t]*\"?([^\]\"\n]+?)\"?[ \t]*\]", re.MULTILINE)
_WORD = re.compile(r"[^\s=(\]-]+")


class _Piece(NamedTuple):
    """A statement or the beginning of a message, with all text up to the next one. message: None outside of a
    message."""

    section: str
    message: str | None
    key: str
    name: str
    text: str


def sym_messages(text: str) -> Separated | None:
    """Messages of a SYM file; None if it has a different version, too many messages, or parts of messages outside of
    any."""
    pieces = list(_pieces(text)) if _HEAD.match(text) else []
    definitions: dict[str, dict[str, str]] = {SIGNALS: {}, _ENUMS: {}}
    messages: dict[tuple[str, str], list[_Piece]] = collections.defaultdict(list)
    for piece in pieces:
        if piece.message is not None:
            messages[piece.section, piece.message].append(piece)
        elif piece.section in _MESSAGES or _BEGINS.search(piece.text):
            return None
        elif piece.key == _DEFINED.get(piece.section):
            known = definitions[piece.section]
            known[piece.name] = known.get(piece.name, "") + piece.text
    repeated = 0
    documents, left = [], max_characters(text)
    for (section, name), own in messages.items():
        document, body = _document(section, own, definitions)
        size = expansion(document)
        documents.append((name, document, body, size.problem()))
        left -= len(document)
        repeated += 0 if size.problem() else size.repeated
        if left < 0 or repeated > MAX_REPEATED or len(documents) > MAX_MESSAGES:
            return None
    found = Separated()
    for name, document, body, problem in documents:
        found.add(functools.partial(_loaded, document, problem), "SYM", _unread(name, body))
    return found


def _loaded(document: str, problem: str) -> list[Any]:
    if problem:
        raise ValueError(problem)
    return loaded_alone(document, "sym")


def _document(section: str, pieces: Sequence[_Piece], definitions: Mapping[str, Mapping[str, str]]) -> tuple[str, str]:
    """Return a file of one message with all its pages, and the text of the message in it."""
    signals, enums = definitions[SIGNALS], definitions[_ENUMS]
    body = "".join(piece.text for piece in pieces)
    names = dict.fromkeys(piece.name for piece in pieces if piece.key == "Sig")
    own = "".join(signals.get(name, "") for name in names)
    words = dict.fromkeys(word[len(_TABLE):] if word.startswith(_TABLE) else word for word in _WORD.findall(own + body))
    return _FILE.format("".join(enums.get(word, "") for word in words), own, section, body), body


def _pieces(text: str) -> Iterator[_Piece]:
    section, message = "", None
    parts = [part for part in PART.finditer(text) if part["section"] or part["message"] is not None or part["key"]]
    for part, end in zip(parts, [*(each.start() for each in parts[1:]), len(text)]):
        if part["section"]:
            section, message = part["section"], None
        elif part["message"] is not None:
            message = unquoted(part["message"])
        name = NAME.match(part["value"] or "")
        # The statement of a section is repeated with each of its messages.
        yield _Piece("" if part["section"] else section, message, part["key"] or "", unquoted(name[0]) if name else "",
                     text[part.start():end])


def _unread(name: str, text: str) -> Iterable[Unread]:
    """Yield all messages that may be in the text of an unreadable one; each may have any of the identifiers."""
    names = dict.fromkeys([name, *_BEGINS.findall(text)])
    numbers = [range(int(low, 16), int(high or low, 16) + 1) for low, high in IDENTIFIERS.findall(text)]
    return [Unread(each, number) for each in names for number in numbers or [range(0)]][:MAX_MESSAGES]
