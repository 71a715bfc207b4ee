"""A file that is not a bag of ROS 1 gets one sentence with its format and the advice."""
# SPDX-License-Identifier: Apache-2.0
import struct

import pytest

from mtr_core.bags.diagnosis import unreadable, unusable


def mcap(profile):
    """Return the head of an MCAP file."""
    content = struct.pack("<I", len(profile)) + profile + struct.pack("<I", 0)
    return b"\x89MCAP0\r\n\x01" + struct.pack("<Q", len(content)) + content


@pytest.mark.parametrize(("content", "words"), [
    (b"SQLite format 3\0" + b"\1" * 100, ("ROS 2", "rosbags-convert")),
    (mcap(b"ros2"), ("ROS 2", "rosbags-convert")),
    (mcap(b"ros1"), ("MCAP file of ROS 1", "the bag from which")),
    (mcap(b""), ("ROS 2", "rosbags-convert")),
    (b"\x89MCAP0\r\n", ("ROS 2", "rosbags-convert")),
    (b"#ROSRECORD V1.2\n", ("format 1.2", "rosbag reindex")),
    (b"#ROSBAG V1.2\n", ("format 1", "rosbag reindex")),
    (b"#ROSRECORD V1.1\n", ("format 1.2", "rosbag reindex")),
    (b"\x28\xb5\x2f\xfd" + b"\0" * 40, ("zstd", "unzstd")),
    (b"\x1f\x8b\x08\0", ("gzip", "gunzip")),
    (b"BZh91AY", ("bzip2", "bunzip2")),
    (b"\xfd7zXZ\0", ("xz", "unxz")),
    (b"\x04\x22\x4d\x18", ("lz4", "unlz4")),
    (b"PK\x03\x04", ("ZIP", "unpack")),
    (b"version https://git-lfs.github.com/spec/v1\n", ("Git LFS", "git lfs pull")),
    (b"\n<!DOCTYPE html>", ("web page", "download")),
    (b"", ("empty", "rosbag record")),
    (b"time,x,y\n0,1,2\n", ("not a bag", "rosbag record"))])
def test_each_kind_of_file_is_named_with_what_to_do(tmp_path, content, words):
    path = tmp_path / "drive.bag"
    path.write_bytes(content)
    sentence = unusable(path)
    assert sentence.startswith(str(path)) and sentence.count("\n") == 0 and all(word in sentence for word in words)
    assert unreadable(path, ValueError("anything")) == sentence


def test_folder_of_ros_2_is_told_from_another_folder(tmp_path):
    assert "it is a folder" in unusable(tmp_path)
    (tmp_path / "metadata.yaml").write_text("rosbag2_bagfile_information: {}\n", encoding="utf-8")
    assert "ROS 2" in unusable(tmp_path)


def test_missing_file_and_bag_of_ros_1(tmp_path):
    assert unusable(tmp_path / "none.bag") == f"{tmp_path / 'none.bag'} cannot be read: No such file or directory."
    path = tmp_path / "drive.bag"
    path.write_bytes(b"#ROSBAG V2.0\n")
    assert unusable(path) == ""


class ROSBagUnindexedException(Exception):
    """Has the name of rosbag's error, which the pure core does not import."""


class ROSBagEncryptException(Exception):
    """Has the name of rosbag's error."""


@pytest.mark.parametrize(("error", "word"), [
    (ROSBagUnindexedException("Unindexed bag"), "rosbag reindex"), (ROSBagEncryptException("key"), "rosbag decrypt"),
    (UnicodeDecodeError("utf-8", b"\xff", 0, 1, "invalid start byte"), "damaged"), (KeyError("op"), "damaged"),
    (struct.error("unpack requires 4 bytes\nand more"), "damaged"), (OSError(5, "Input/output error"), "Input/output"),
    (RuntimeError(""), "damaged (RuntimeError)")])
def test_error_of_the_library_becomes_one_sentence(tmp_path, error, word):
    path = tmp_path / "drive.bag"
    path.write_bytes(b"#ROSBAG V2.0\n")
    sentence = unreadable(path, error)
    assert str(path) in sentence and word in sentence and "\n" not in sentence
