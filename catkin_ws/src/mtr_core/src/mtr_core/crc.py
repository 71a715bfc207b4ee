"""Check sum inside messages on the serial line: rosserial's own is an 8-bit sum, which two errors can cancel."""
# SPDX-License-Identifier: Apache-2.0
import binascii
import io
from typing import Any

CRC_BYTES = 2
INITIAL = 0xFFFF


def crc16(data: bytes) -> int:
    """CRC-16/CCITT-FALSE: polynomial 0x1021, initially 0xFFFF."""
    return binascii.crc_hqx(data, INITIAL)


def seal(message: Any) -> Any:
    """Fill in the last field, crc, from the serialized fields before it; returns the message."""
    message.crc = _wanted(message)
    return message


def is_sound(message: Any) -> bool:
    """True when the message is as it was sealed."""
    return bool(message.crc == _wanted(message))


def _wanted(message: Any) -> int:
    buffer = io.BytesIO()
    message.serialize(buffer)
    return crc16(buffer.getvalue()[:-CRC_BYTES])
