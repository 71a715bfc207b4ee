"""Messages of an ARXML database one by one, so that a faulty one costs no other."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import inspect
from typing import Any
from xml.etree import ElementTree

from .alone import MAX_MESSAGES, Separated, single
from .car_database import Unread

# Overridden methods of the library's reader, with their parameters; other versions may have others.
_OVERRIDDEN = {"_load_message": ["self", "bus_name", "can_frame_triggering"],
               "_load_package_messages": ["self", "package_elem"]}
# Limit of the signals of all messages: per signal that the file lists, and a constant. Messages may share signals.
_PER_SIGNAL, _BESIDES = 4, 4096
_SIGNAL = "I-SIGNAL-TO-I-PDU-MAPPING"


def arxml_messages(text: str) -> Separated | None:
    """Messages of an AUTOSAR system; None if the library's reader has a different structure, or there are too many."""
    try:
        # The reader is not part of the library's interface. If it was moved, all other databases are still readable.
        from cantools.database.can.formats.arxml import SystemLoader, is_ecu_extract  # type: ignore[attr-defined]
    except ImportError:
        return None
    if any(_parameters(SystemLoader, name) != known for name, known in _OVERRIDDEN.items()):
        return None
    root = ElementTree.fromstring(text)
    if is_ecu_extract(root):
        # The library reads its messages from other elements.
        return None
    tags = collections.Counter(each.tag.rpartition("}")[2] for each in root.iter())
    if tags["CAN-FRAME-TRIGGERING"] > MAX_MESSAGES:
        return None
    separated = Separated()
    loader = _loader(SystemLoader, separated, _PER_SIGNAL * tags[_SIGNAL] + _BESIDES)
    messages = list(loader(root, False).load().messages)
    if len(messages) != len(separated.messages) or {*map(id, messages)} != {*map(id, separated.messages)}:
        # Messages were loaded in a different way than by the overridden methods.
        return None
    separated.messages = messages
    return separated


def _parameters(reader: Any, name: str) -> list[str]:
    method = getattr(reader, name, None)
    return [*inspect.signature(method).parameters] if callable(method) else []


def _loader(inherited: Any, separated: Separated, max_signals: int) -> Any:
    """Return the library's reader, changed to skip unreadable messages. Messages cannot be cut out of the file, because
    each may refer to any place in it."""

    signals = 0

    class Loader(inherited):
        """See above."""

        def _load_message(self, bus_name: Any, can_frame_triggering: Any) -> Any:
            def read() -> list[Any]:
                if _text(can_frame_triggering, "IDENTIFIER") is None:
                    raise ValueError("its identifier is missing")
                return [inherited._load_message(self, bus_name, can_frame_triggering)]

            nonlocal signals
            if signals > max_signals:
                raise OverflowError("several messages refer to the same signals too often")
            before = len(separated.messages)
            separated.add(read, "ARXML", [Unread(*_frame(can_frame_triggering), bus_name)])
            message = next(iter(separated.messages[before:]), None)
            signals += len(message.signals) if message is not None else 0
            return message

        def _load_package_messages(self, package_elem: Any) -> list[Any]:
            found = inherited._load_package_messages(self, package_elem)
            return [each for each in found if each is not None]

    return Loader


def _frame(triggering: ElementTree.Element) -> tuple[str, range]:
    """Return the name of the frame of a triggering, and its identifier."""
    reference = _text(triggering, "FRAME-REF") or _text(triggering, "SHORT-NAME") or ""
    return reference.rpartition("/")[2].strip(), single(_text(triggering, "IDENTIFIER") or "")


def _text(element: ElementTree.Element, tag: str) -> str | None:
    return next((each.text for each in element if each.tag.rpartition("}")[2] == tag), None)
