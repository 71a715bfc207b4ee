"""Payloads and reserved topic ids of the rosserial protocol."""
# SPDX-License-Identifier: Apache-2.0
import enum
import struct
from typing import NamedTuple, Tuple

MD5_LENGTH = 32
# First id of endpoints defined by the device.
MIN_ENDPOINT_ID = 100


class ReservedId(enum.IntEnum):
    """Reserved topic ids; a service has one id per direction."""

    PUBLISHER = 0
    SUBSCRIBER = 1
    SERVICE_RESPONSE = 2
    SERVICE_REQUEST = 3
    PARAMETER = 6
    LOG = 7
    TIME = 10
    STOP = 11


class WireError(ValueError):
    """A payload that does not match its topic id."""


class TopicInfo(NamedTuple):
    """Description of one endpoint by the device; buffer_bytes limits the length of messages to it."""

    topic_id: int
    name: str
    type_name: str
    md5: str
    buffer_bytes: int


class LogLine(NamedTuple):
    """A log text of the device; level 0 debug to 4 fatal."""

    level: int
    text: str


def decode_topic_info(payload: bytes) -> TopicInfo:
    """Decode a description in a negotiation frame.

    Raises:
        WireError: the payload is invalid.
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
    """Return the payload of a negotiation frame, as sent by a device."""
    texts = b"".join(struct.pack("<I", len(text)) + text.encode()
                     for text in (info.name, info.type_name, info.md5))
    return struct.pack("<H", info.topic_id) + texts + struct.pack("<i", info.buffer_bytes)


def decode_log(payload: bytes) -> LogLine:
    """Decode a log text of the device; WireError if it is invalid."""
    try:
        text, _ = _text(payload, 1)
        return LogLine(payload[0], text)
    except (struct.error, IndexError, UnicodeDecodeError) as error:
        raise WireError(f"A log line of the firmware could not be read: {error}.") from error


def encode_log(line: LogLine) -> bytes:
    """Return the payload of a log frame, as sent by a device."""
    text = line.text.encode()
    return struct.pack("<BI", line.level, len(text)) + text


def encode_time(time_ns: int) -> bytes:
    """Return the host's clock, as the answer to a TIME request."""
    return struct.pack("<II", time_ns // 1_000_000_000 % 2 ** 32, time_ns % 1_000_000_000)


def decode_time(payload: bytes) -> int:
    """Return nanoseconds of a TIME payload; WireError if it is invalid."""
    try:
        seconds, nanoseconds = struct.unpack("<II", payload)
    except struct.error as error:
        raise WireError(f"A time could not be read: {error}.") from error
    return seconds * 1_000_000_000 + nanoseconds


def _text(payload: bytes, offset: int) -> Tuple[str, int]:
    """Return a text with a preceding length, and the offset behind it."""
    (length,) = struct.unpack_from("<I", payload, offset)
    start = offset + 4
    if length > len(payload) - start:
        raise struct.error(f"{length} bytes of text announced, {len(payload) - start} are there")
    return payload[start:start + length].decode(), start + length
