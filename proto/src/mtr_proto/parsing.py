"""Bytes of the link to a message: all of them, or none."""
# SPDX-License-Identifier: Apache-2.0
import warnings
from typing import Any

from google.protobuf.message import DecodeError

# The reader in C++ says so, takes what comes before that tag for the whole message, and drops the rest.
warnings.filterwarnings("ignore", message="Unexpected end-group tag", category=RuntimeWarning)


def parse_whole(message: Any, data: bytes) -> None:
    """Fill a message; DecodeError when the bytes are none, or go on behind its end."""
    # ParseFromString of Noetic's protobuf does not say how many bytes it took.
    message.Clear()
    if message.MergeFromString(data) != len(data):
        raise DecodeError(f"Of {len(data)} bytes not all belong to the message.")
