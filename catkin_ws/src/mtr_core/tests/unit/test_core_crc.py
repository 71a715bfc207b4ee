"""The checksum inside messages of the serial line."""
# SPDX-License-Identifier: Apache-2.0
import struct

from mtr_core.crc import crc16, is_sound, seal


class Message:
    """A message with one value, serializable like genpy's messages."""

    def __init__(self, value, crc=0):
        self.value, self.crc = value, crc

    def serialize(self, buffer):
        buffer.write(struct.pack("<IH", self.value, self.crc))


def test_crc_is_that_of_the_catalogue():
    assert crc16(b"123456789") == 0x29B1


def test_sealed_message_is_sound():
    assert is_sound(seal(Message(5)))


def test_two_errors_that_cancel_in_a_sum_are_seen():
    sealed = seal(Message(0x0102))
    assert not is_sound(Message(0x0201, sealed.crc))
