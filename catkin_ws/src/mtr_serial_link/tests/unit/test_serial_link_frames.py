"""Frames of the serial line: round trip, corruption, and resynchronization."""
# SPDX-License-Identifier: Apache-2.0
import random

import pytest
from hypothesis import given
from hypothesis import strategies as some

from mtr_serial_link.frames import MAX_PAYLOAD_BYTES, FrameParser, SerialFrame, encode, length_check
from mtr_serial_link.wire import (
    LogLine,
    TopicInfo,
    WireError,
    decode_log,
    decode_time,
    decode_topic_info,
    encode_log,
    encode_time,
    encode_topic_info,
)

GOOD = [SerialFrame(125, b"one"), SerialFrame(126, b"\xff\xfe\xff\xfe"), SerialFrame(101, b"")]
STREAM = b"".join(map(encode, GOOD))
FUZZED_FRAMES = 200_000
BLOCK_FRAMES = 2000


def test_request_for_topics_is_the_protocols_own_example():
    assert encode(SerialFrame(0, b"")) == bytes.fromhex("ff fe 00 00 ff 00 00 ff")
    assert encode(SerialFrame(11, b"")) == bytes.fromhex("ff fe 00 00 ff 0b 00 f4")


@given(some.lists(some.builds(SerialFrame, some.integers(0, 65535), some.binary(max_size=300)), max_size=5),
       some.integers(1, 50))
def test_frames_survive_the_way_in_pieces_of_any_size(frames, size):
    parser, stream = FrameParser(), b"".join(map(encode, frames))
    found = [frame for start in range(0, len(stream), size) for frame in parser.feed(stream[start:start + size])]
    assert found == frames and parser.counts.skipped_bytes == 0


@pytest.mark.parametrize("damaged", range(len(encode(SerialFrame(125, b"payload")))))
def test_one_damaged_byte_costs_one_frame_and_no_more(damaged):
    bad = bytearray(encode(SerialFrame(125, b"payload")))
    bad[damaged] ^= 0x20
    parser = FrameParser()
    found = parser.feed(bytes(bad) + STREAM)
    found += parser.forget()
    assert found == GOOD


def test_frame_that_was_cut_off_gives_way_to_what_follows_a_pause():
    parser = FrameParser()
    assert parser.feed(encode(SerialFrame(125, bytes(200)))[:50] + STREAM) == []
    assert parser.forget() == GOOD


def test_frames_cut_off_within_each_other_give_way_to_what_follows_a_pause_at_once():
    parser = FrameParser()
    cut_off = encode(SerialFrame(125, bytes(200)))[:50]
    assert parser.feed(3 * cut_off + STREAM) == []
    assert parser.forget() == GOOD and not parser.has_partial_frame


def test_rubbish_without_frames_is_skipped_and_not_kept():
    parser = FrameParser()
    assert parser.feed(bytes(range(255)) * 100) == []
    assert parser.counts.skipped_bytes >= 255 * 100 - 8


def test_length_beyond_the_limit_is_damage_though_its_check_is_right():
    parser = FrameParser(64)
    length = 65
    header = b"\xff\xfe" + length.to_bytes(2, "little") + bytes((length_check(length),)) + b"\x7d\x00"
    assert parser.feed(header + STREAM) == GOOD
    assert parser.counts.checksum_errors == 1


def test_payload_that_is_too_long_is_refused():
    with pytest.raises(ValueError, match="does not fit"):
        encode(SerialFrame(100, bytes(MAX_PAYLOAD_BYTES + 1)))


def test_mutated_frames_never_stop_the_parser_and_it_is_back_within_two_good_ones():
    random_bytes, parser = random.Random(7), FrameParser(512)
    # Random.randbytes requires a newer Python than 3.8 of the robot.
    payloads = [bytes(random_bytes.randrange(256) for _ in range(random_bytes.randrange(24)))
                for _ in range(BLOCK_FRAMES)]
    block = [encode(SerialFrame(random_bytes.randrange(65536), payload)) for payload in payloads]
    for _ in range(FUZZED_FRAMES // BLOCK_FRAMES):
        stream = bytearray(b"".join(block))
        for _ in range(BLOCK_FRAMES):
            stream[random_bytes.randrange(len(stream))] = random_bytes.randrange(256)
        parser.feed(bytes(stream))
        # After a pause, the line works again.
        parser.forget()
        assert not parser.has_partial_frame
        assert parser.feed(STREAM) == GOOD


@given(some.binary(max_size=200))
def test_any_payload_is_understood_or_refused_with_a_sentence(payload):
    for decode in (decode_topic_info, decode_log, decode_time):
        try:
            decode(payload)
        except WireError as error:
            assert str(error).endswith(".")


def test_protocol_payloads_survive_the_way():
    info = TopicInfo(125, "/firmware/state", "mtr_msgs/FirmwareState", "0123456789abcdef" * 2, 280)
    assert decode_topic_info(encode_topic_info(info)) == info
    assert decode_log(encode_log(LogLine(2, "Příliš"))) == LogLine(2, "Příliš")
    assert decode_time(encode_time(1_234_567_890_123_456_789)) == 1_234_567_890_123_456_789
