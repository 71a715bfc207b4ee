"""Writes type, MD5 and size of the firmware's ROS messages as a C++ header, from their .msg files.

Usage: definitions.py MSG_DIRECTORY HEADER
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys

from genmsg import MsgContext
from genmsg.base import InvalidMsgSpec
from genmsg.gentools import compute_md5
from genmsg.msg_loader import load_msg_from_file
from genmsg.msgs import MsgSpec, parse_type

PACKAGE = "mtr_msgs"
SIZES = {"bool": 1, "int8": 1, "uint8": 1, "int16": 2, "uint16": 2, "int32": 4, "uint32": 4, "int64": 8, "uint64": 8,
         "float32": 4, "float64": 8, "time": 8, "duration": 8}
HEAD = """/// @file
/// Types, sums and sizes of messages; made by tools/definitions.py.
// SPDX-License-Identifier: Apache-2.0
#pragma once
"""


def size_of(spec: MsgSpec) -> int:
    """Bytes of a serialized message; only messages of fixed size fit the firmware."""
    total = 0
    for field_type in spec.types:
        base, is_array, length = parse_type(field_type)
        if base not in SIZES or (is_array and length is None):
            raise InvalidMsgSpec(f"{spec.full_name}: {field_type} has no fixed size.")
        total += SIZES[base] * (length if is_array else 1)
    return total


def lines(path: pathlib.Path) -> str:
    """Definitions of one message."""
    name = f"{PACKAGE}/{path.stem}"
    context = MsgContext.create_default()
    spec = load_msg_from_file(context, str(path), name)
    md5 = compute_md5(context, spec)
    prefix = f"MTR_{path.stem.upper()}"
    return f'\n#define {prefix}_TYPE "{name}"\n#define {prefix}_MD5 "{md5}"\n#define {prefix}_BYTES {size_of(spec)}\n'


def main() -> int:
    """Write the header."""
    folder, header = map(pathlib.Path, sys.argv[1:])
    text = HEAD + "".join(lines(path) for path in sorted(folder.glob("Firmware*.msg")))
    header.parent.mkdir(parents=True, exist_ok=True)
    header.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
