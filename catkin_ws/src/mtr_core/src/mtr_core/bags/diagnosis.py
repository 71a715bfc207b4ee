"""Diagnosis of a file that is not a readable bag of ROS 1: its format, and how to convert it, in one sentence."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import struct
from typing import NamedTuple, Tuple

HEAD_BYTES = 256
ROS1_HEAD = b"#ROSBAG V2."
MCAP_HEAD = b"\x89MCAP0\r\n"
# An MCAP file starts with magic, opcode 1 of the header record and its length, then the profile's length and text.
# https://mcap.dev/spec
MCAP_PROFILE_AT = len(MCAP_HEAD) + 1 + 8

TO_ROS1 = "convert it with `rosbags-convert --src {source} --dst NEW.bag` (package rosbags of PyPI)"
REINDEX = "`rosbag reindex {source}`"


class Kind(NamedTuple):
    """Files that start with `head`: their format and the advice. {source} in the advice is the file."""

    head: bytes
    what: str
    advice: str


KINDS: Tuple[Kind, ...] = (
    Kind(b"#ROSRECORD V", "a bag of a ROS older than 1.2 or in format 1.2", f"write it in format 2.0 with {REINDEX}"),
    Kind(b"#ROSBAG V1", "a bag in format 1", f"write it in format 2.0 with {REINDEX}"),
    Kind(b"SQLite format 3\0", "a bag of ROS 2 (SQLite)", TO_ROS1),
    Kind(b"\x28\xb5\x2f\xfd", "compressed by zstd, as bags of ROS 2 often are", "decompress it with `unzstd`"),
    Kind(b"\x1f\x8b", "compressed by gzip", "decompress it with `gunzip`"),
    Kind(b"BZh", "compressed by bzip2", "decompress it with `bunzip2`"),
    Kind(b"\xfd7zXZ\0", "compressed by xz", "decompress it with `unxz`"),
    Kind(b"\x04\x22\x4d\x18", "compressed by lz4", "decompress it with `unlz4`"),
    Kind(b"PK\x03\x04", "a ZIP archive", "unpack it"),
    Kind(b"7z\xbc\xaf\x27\x1c", "a 7z archive", "unpack it"),
    Kind(b"version https://git-lfs", "a pointer of Git LFS instead of the bag", "fetch the bag with `git lfs pull`"),
    Kind(b"<", "a web page or XML document", "download the bag itself"),
)
NO_BAG = "not a bag", "give a bag that was recorded with `rosbag record` of ROS 1"


def unusable(path: pathlib.Path) -> str:
    """Return a sentence about a path that is not a bag of ROS 1 in format 2.0; empty if it starts like one."""
    if path.is_dir():
        is_ros2 = (path / "metadata.yaml").is_file()
        return _sentence(path, *(("a bag of ROS 2 (folder)", TO_ROS1) if is_ros2 else ("a folder", NO_BAG[1])))
    try:
        with path.open("rb") as file:
            head = file.read(HEAD_BYTES)
    except OSError as error:
        return f"{path} cannot be read: {error.strerror or error}."
    if head.startswith(ROS1_HEAD):
        return ""
    return _sentence(path, *_kind(head))


def unreadable(path: pathlib.Path, error: Exception) -> str:
    """Return a sentence about a bag that the library failed to read. A damaged bag may raise any error."""
    sentence = unusable(path)
    if sentence:
        return sentence
    name = type(error).__name__
    for part, what, advice in _LIBRARY:
        if part in name:
            return _sentence(path, what, advice)
    if isinstance(error, OSError) and error.strerror:
        return f"{path} cannot be read: {error.strerror}."
    if name == "ROSBagException" and "no message" in str(error):
        return f"{path} cannot be read: it holds no message; give another recording."
    return _sentence(path, f"damaged ({_first_line(error) or name})",
                     f"save what can be read with {REINDEX}, or give another recording")


# Parts of the names of rosbag's error classes, which the pure core does not import.
_LIBRARY = (
    ("Unindexed", "without an index, because its recording was cut off", f"repair it with {REINDEX}"),
    ("Encrypt", "encrypted", "decrypt it with `rosbag decrypt {source}`"),
)


def _kind(head: bytes) -> Tuple[str, str]:
    if not head:
        return "empty", NO_BAG[1]
    if head.startswith(MCAP_HEAD):
        return _mcap(head)
    text = head.lstrip()
    return next(((kind.what, kind.advice) for kind in KINDS if text.startswith(kind.head)), NO_BAG)


def _mcap(head: bytes) -> Tuple[str, str]:
    profile = b""
    if len(head) >= MCAP_PROFILE_AT + 4:
        length, = struct.unpack_from("<I", head, MCAP_PROFILE_AT)
        profile = head[MCAP_PROFILE_AT + 4:MCAP_PROFILE_AT + 4 + min(length, HEAD_BYTES)]
    if profile == b"ros1":
        return "an MCAP file of ROS 1", "give the bag from which it was written"
    return "a bag of ROS 2 (MCAP)", TO_ROS1


def _sentence(path: pathlib.Path, what: str, advice: str) -> str:
    return f"{path} cannot be read: it is {what}; {advice.format(source=path)}."


def _first_line(error: Exception) -> str:
    return (str(error).strip().splitlines() or [""])[0].rstrip(".")[:80]
