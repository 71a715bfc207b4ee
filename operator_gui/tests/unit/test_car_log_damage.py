"""Binary logs of a bus that are damaged or hostile: bounded memory, the true reason, and the frames before it."""
# SPDX-License-Identifier: Apache-2.0
import struct
import tracemalloc
import zlib

import can
import pytest

from mtr_operator.car_link.log.blf_log import MAX_CONTAINER_BYTES
from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.errors import ConnectionFailed

FILE_HEADER, CONTAINER_HEADER = 144, 32
COUNT = 60
MIB = 1024 ** 2


def messages(count=COUNT):
    for index in range(count):
        yield can.Message(timestamp=1.7e9 + 0.01 * index, arbitration_id=0x100 + index % 3, is_extended_id=False,
                          data=(index * 2654435761 % 2 ** 64).to_bytes(8, "little"), channel=0)


FRAMES = [(each.arbitration_id, bytes(each.data)) for each in messages()]


def written(path, container_bytes=480, level=-1):
    """Bytes of a sound log: ten frames in each container."""
    with can.BLFWriter(str(path), compression_level=level, max_container_size=container_bytes) as log:
        for message in messages():
            log.on_message_received(message)
    return path.read_bytes()


def containers(whole):
    """Begins of the containers."""
    place, begins = FILE_HEADER, []
    while place < len(whole):
        length = int.from_bytes(whole[place + 8:place + 12], "little")
        begins.append(place)
        place += length + length % 4
    return begins


def container(packed, stated, method=2, length=None):
    length = CONTAINER_HEADER + len(packed) if length is None else length
    return struct.pack("<4sHHLLH6xL4x", b"LOBJ", 16, 1, length, 10, method, stated) + packed + bytes(len(packed) % 4)


def log_of(path, *parts):
    """A file with the header of a sound log, and its own size in it."""
    whole = written(path)[:FILE_HEADER] + b"".join(parts)
    path.write_bytes(whole[:16] + len(whole).to_bytes(8, "little") + whole[24:])
    return path


def outcome(path):
    """Frames, and the sentence that says what is wrong."""
    frames, read = [], None
    try:
        read = ReadLog(path)
        frames += [(frame.can_id, frame.data) for frame in read]
    except ConnectionFailed as error:
        return frames, str(error)
    return frames, read.ending


@pytest.mark.parametrize("stated", [0, MAX_CONTAINER_BYTES + 1, MAX_CONTAINER_BYTES, 2 ** 32 - 1])
def test_container_that_inflates_to_more_than_it_may_is_refused_in_little_memory(tmp_path, stated):
    packer = zlib.compressobj(9)
    packed = b"".join([*(packer.compress(bytes(MIB)) for _ in range(40)), packer.flush()])
    path = log_of(tmp_path / "bus.blf", container(packed, stated))
    tracemalloc.start()
    frames, sentence = outcome(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert frames == [] and sentence.startswith(f"The CAN log {path} cannot be read: the container at byte 144 ")
    assert f"{stated} " in sentence and peak < 2 * MAX_CONTAINER_BYTES + 8 * MIB


def test_object_that_never_ends_does_not_fill_the_memory(tmp_path):
    begin = struct.pack("<4sHHLL", b"LOBJ", 32, 1, MAX_CONTAINER_BYTES + 1, 1)
    zeros = zlib.compress(bytes(MIB))
    path = log_of(tmp_path / "bus.blf", container(zlib.compress(begin), len(begin)),
                  *[container(zeros, MIB) for _ in range(20)])
    frames, sentence = outcome(path)
    assert frames == [] and f"an object states a length of {MAX_CONTAINER_BYTES + 1} bytes" in sentence


@pytest.mark.parametrize("length", [0, 71, 4097, 2 ** 32 - 1])
def test_header_with_an_impossible_length_is_refused(tmp_path, length):
    path = tmp_path / "bus.blf"
    whole = written(path)
    path.write_bytes(whole[:4] + length.to_bytes(4, "little") + whole[8:])
    assert outcome(path) == ([], f"The CAN log {path} cannot be read: its header states a length of {length} bytes, "
                                 "and has 144.")


def changed(whole, place):
    return whole[:place] + bytes([whole[place] ^ 0x55]) + whole[place + 1:]


def check_damage(path, number):
    """No frame is wrong, those of the containers before the damage are used, and the reason names the byte."""
    frames, sentence = outcome(path)
    assert frames == FRAMES[:len(frames)] and len(frames) >= 10 * number
    assert "holds no frame" not in sentence
    if len(frames) < COUNT:
        assert ("is damaged after" if frames else "cannot be read: ") in sentence
        assert "at byte" in sentence and sentence.endswith(".")


def test_changed_byte_ends_the_log_there_and_no_frame_behind_it_is_used(tmp_path):
    path = tmp_path / "bus.blf"
    whole = written(path)
    begins = containers(whole)
    assert outcome(path) == (FRAMES, "") and len(begins) == 6
    for place in range(FILE_HEADER, len(whole), 3):
        path.write_bytes(changed(whole, place))
        check_damage(path, max(at for at, begin in enumerate(begins) if begin <= place))


def test_changed_signature_or_length_of_an_object_ends_the_log_there(tmp_path):
    path = tmp_path / "bus.blf"
    whole = written(path, level=0)
    for number, begin in enumerate(containers(whole)):
        for place in (0, 3, 8, 9, 10, 11):
            path.write_bytes(changed(whole, begin + CONTAINER_HEADER + 48 + place))
            frames, sentence = outcome(path)
            assert frames == FRAMES[:len(frames)] and len(frames) - 10 * number in (1, 2)
            assert "is damaged after" in sentence and "at byte" in sentence


def test_damaged_container_is_named_and_those_before_it_are_used(tmp_path):
    path = tmp_path / "bus.blf"
    whole = written(path)
    third = containers(whole)[2]
    path.write_bytes(whole[:third + 100] + bytes([whole[third + 100] ^ 1]) + whole[third + 101:])
    assert outcome(path) == (FRAMES[:20], f"The CAN log {path} is damaged after 20 frames (the compressed data of the "
                                          f"container at byte {third} is corrupt); those are used.")


@pytest.mark.parametrize("level", [-1, 0], ids=["compressed", "not compressed"])
def test_log_that_is_cut_off_anywhere_is_used_up_to_there_and_says_so(tmp_path, level):
    path = tmp_path / "bus.blf"
    whole = written(path, level=level)
    for length in range(FILE_HEADER, len(whole), 9):
        path.write_bytes(whole[:length])
        frames, sentence = outcome(path)
        assert frames == FRAMES[:len(frames)], length
        assert len(frames) >= 10 * sum(begin <= length for begin in containers(whole)[1:]), length
        assert "is cut off after" in sentence or (not frames and "it is cut off before its first" in sentence), length


@pytest.mark.parametrize(("parts", "words"), [
    ([b"\xa7" * 500], "no object begins at byte 144"),
    ([container(bytes(range(200)), 200)], "the compressed data of the container at byte 144 is corrupt"),
    ([container(zlib.compress(bytes(100))[:-5], 100)], "the container at byte 144 is incomplete"),
    ([container(b"", 0, method=7)], "the container at byte 144 has the unknown compression method 7"),
    ([container(b"", 0, length=20), bytes(4)], "the container at byte 144 is shorter than its header"),
    ([container(b"", 0, length=5000)], "the object at byte 144 states 5000 bytes, more than the file has"),
    ([container(b"", 0, length=2 ** 31), bytes(64)], "states 2147483648 bytes, more than the file has"),
    ([struct.pack("<4sHHLL", b"LOBJ", 32, 1, 48, 1) + bytes(32)], "the object at byte 144 is of kind 1"),
    ([container(b"\0" * 64, 64, method=0)], "in the container at byte 144, no object begins"),
    ([container(struct.pack("<4sHHLL", b"LOBJ", 32, 1, 32, 1) + bytes(16), 32, method=0)],
     "an object states a length of 32 bytes")])
def test_each_damage_of_a_blf_has_its_own_reason(tmp_path, parts, words):
    frames, sentence = outcome(log_of(tmp_path / "bus.blf", *parts))
    assert frames == [] and words in sentence and "cannot be read: " in sentence and sentence.endswith(".")


def test_restore_points_between_containers_are_no_damage(tmp_path):
    whole = written(tmp_path / "sound.blf")
    begins = [*containers(whole), len(whole)]
    points = struct.pack("<4sHHLL", b"LOBJ", 16, 1, 30, 115) + bytes(14 + 30 % 4)
    parts = [whole[begin:end] for begin, end in zip(begins, begins[1:])]
    assert outcome(log_of(tmp_path / "points.blf", parts[0], points, *parts[1:], points)) == (FRAMES, "")


def test_sound_blf_without_a_frame_holds_none(tmp_path):
    path = tmp_path / "bus.blf"
    with can.BLFWriter(str(path)):
        pass
    assert outcome(path) == ([], f"The CAN log {path} holds no frame.")


@pytest.mark.parametrize("size", [MIB, 100, 48, 50])
def test_objects_across_containers_are_read(tmp_path, size):
    path = tmp_path / "bus.blf"
    written(path, container_bytes=size)
    assert outcome(path) == (FRAMES, "")
