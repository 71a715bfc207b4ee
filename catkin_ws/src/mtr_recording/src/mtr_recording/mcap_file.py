"""Writes a recording as MCAP, which more programs support than ROS 1 bags. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import Any, Dict, Iterable, NamedTuple, Optional, Tuple

from .profiles import CannotRecord

Writer: Optional[Any]
try:
    from mcap.writer import Writer
except ImportError:  # no rosdep key: who wants MCAP installs it
    Writer = None

# Names in MCAP's registry of profiles and encodings.
PROFILE, SCHEMA_ENCODING, MESSAGE_ENCODING = "ros1", "ros1msg", "ros1"
# Suffix during writing, so that an incomplete file is not mistaken for a recording.
UNFINISHED = ".part"


class Recorded(NamedTuple):
    """Message as stored in a bag.

    Attributes:
        type: such as "std_msgs/Header".
        definition: of the type and all nested types, as ROS sends it to subscribers.
        data: serialized.
        time_ns: of its arrival, on the robot's clock.
    """

    topic: str
    type: str
    definition: str
    data: bytes
    time_ns: int


def check_mcap() -> None:
    """Raise CannotRecord if the library is missing."""
    if Writer is None:
        raise CannotRecord("MCAP is written with the Python package mcap, which is not installed: pip install mcap; or "
                           "leave --mcap out.")


def write_mcap(path: pathlib.Path, messages: Iterable[Recorded]) -> int:
    """Write all messages and return their number; the file exists only if all of them were written."""
    check_mcap()
    assert Writer is not None
    unfinished, count = path.with_name(path.name + UNFINISHED), 0
    with unfinished.open("wb") as file:
        writer = Writer(file)
        writer.start(profile=PROFILE)
        channels = _Channels(writer)
        for message in messages:
            count += 1
            writer.add_message(channels.of(message), log_time=message.time_ns, publish_time=message.time_ns,
                               data=message.data)
        writer.finish()
    unfinished.replace(path)
    return count


class _Channels:
    """Channels by topic and type, with one schema for each definition of a type."""

    def __init__(self, writer: Any):
        self._writer = writer
        self._schemas: Dict[Tuple[str, str], int] = {}
        self._channels: Dict[Tuple[str, str, str], int] = {}

    def of(self, message: Recorded) -> int:
        """Return the channel id of a message; the first message registers it."""
        known = (message.topic, message.type, message.definition)
        if known not in self._channels:
            self._channels[known] = self._writer.register_channel(
                topic=message.topic, message_encoding=MESSAGE_ENCODING, schema_id=self._schema(known[1:]))
        return self._channels[known]

    def _schema(self, known: Tuple[str, str]) -> int:
        if known not in self._schemas:
            name, definition = known
            self._schemas[known] = self._writer.register_schema(name=name, encoding=SCHEMA_ENCODING,
                                                                data=definition.encode())
        return self._schemas[known]
