"""Checksum inside messages on the serial line: rosserial's own 8-bit sum misses some double errors."""
# SPDX-License-Identifier: Apache-2.0
import binascii
import io
from typing import Any

CRC_BYTES = 2
INITIAL = 0xFFFF


def crc16(data: bytes) -> int:
    """Return CRC-16/CCITT-FALSE: polynomial 0x1021, initial value 0xFFFF."""
    return binascii.crc_hqx(data, INITIAL)


def seal(message: Any) -> Any:
    """Set the last field, crc, from the serialized fields before it, and return the message."""
    message.crc = _wanted(message)
    return message


def is_sound(message: Any) -> bool:
    """Return True if the message has the crc of its fields."""
    return bool(message.crc == _wanted(message))


def _wanted(message: Any) -> int:
    buffer = io.BytesIO()
    message.serialize(buffer)
    return crc16(buffer.getvalue()[:-CRC_BYTES])
