"""Payloads that the rosserial protocol itself defines, and their topic ids."""
# SPDX-License-Identifier: Apache-2.0
import enum
import struct
from typing import NamedTuple, Tuple

MD5_LENGTH = 32
# Endpoints of the device's own choosing have ids from here on.
MIN_ENDPOINT_ID = 100


class ReservedId(enum.IntEnum):
    """Topic ids with a meaning of their own; a service has one id for each direction."""

    PUBLISHER = 0
    SUBSCRIBER = 1
    SERVICE_RESPONSE = 2
    SERVICE_REQUEST = 3
    PARAMETER = 6
    LOG = 7
    TIME = 10
    STOP = 11


class WireError(ValueError):
    """A payload is not what its topic id promises."""


class TopicInfo(NamedTuple):
    """The device's description of one of its endpoints; buffer_bytes bounds what it can take."""

    topic_id: int
    name: str
    type_name: str
    md5: str
    buffer_bytes: int


class LogLine(NamedTuple):
    """A sentence of the device; level 0 debug to 4 fatal."""

    level: int
    text: str


def decode_topic_info(payload: bytes) -> TopicInfo:
    """Description in a negotiation frame.

    Raises:
        WireError: it makes no sense.
    """
    try:
        (topic_id,) = struct.unpack_from("<H", payload)
        name, offset = _text(payload, 2)
        type_name, offset = _text(payload, offset)
        md5, offset = _text(payload, offset)
        (buffer_bytes,) = struct.unpack_from("<i", payload, offset)
    except (struct.error, UnicodeDecodeError) as error:
        raise WireError(f"A description of a topic could not be read: {error}.") from error
    if topic_id < MIN_ENDPOINT_ID or not name or "/" not in type_name or len(md5) != MD5_LENGTH:
        raise WireError(f"The description of topic {topic_id} ('{name}', '{type_name}') makes no sense.")
    return TopicInfo(topic_id, name, type_name, md5, buffer_bytes)


def encode_topic_info(info: TopicInfo) -> bytes:
    """Payload of a negotiation frame, as a device sends it."""
    texts = b"".join(struct.pack("<I", len(text)) + text.encode()
                     for text in (info.name, info.type_name, info.md5))
    return struct.pack("<H", info.topic_id) + texts + struct.pack("<i", info.buffer_bytes)


def decode_log(payload: bytes) -> LogLine:
    """A sentence of the device; WireError."""
    try:
        text, _ = _text(payload, 1)
        return LogLine(payload[0], text)
    except (struct.error, IndexError, UnicodeDecodeError) as error:
        raise WireError(f"A log line of the firmware could not be read: {error}.") from error


def encode_log(line: LogLine) -> bytes:
    """Payload of a log frame, as a device sends it."""
    text = line.text.encode()
    return struct.pack("<BI", line.level, len(text)) + text


def encode_time(time_ns: int) -> bytes:
    """The host's clock, in answer to a TIME request."""
    return struct.pack("<II", time_ns // 1_000_000_000 % 2 ** 32, time_ns % 1_000_000_000)


def decode_time(payload: bytes) -> int:
    """Nanoseconds of a TIME payload; WireError."""
    try:
        seconds, nanoseconds = struct.unpack("<II", payload)
    except struct.error as error:
        raise WireError(f"A time could not be read: {error}.") from error
    return seconds * 1_000_000_000 + nanoseconds


def _text(payload: bytes, offset: int) -> Tuple[str, int]:
    """Text with its length before it, and the offset behind it."""
    (length,) = struct.unpack_from("<I", payload, offset)
    start = offset + 4
    if length > len(payload) - start:
        raise struct.error(f"{length} bytes of text announced, {len(payload) - start} are there")
    return payload[start:start + length].decode(), start + length
