"""Parses bytes of the link as one message, completely or not at all."""
# SPDX-License-Identifier: Apache-2.0
import warnings
from typing import Any

from google.protobuf.message import DecodeError

# The C++ parser warns, treats the bytes before that tag as the whole message, and drops the rest.
warnings.filterwarnings("ignore", message="Unexpected end-group tag", category=RuntimeWarning)


def parse_whole(message: Any, data: bytes) -> None:
    """Fill a message; DecodeError if the bytes are invalid or continue after its end."""
    # ParseFromString of Noetic's protobuf does not return the number of parsed bytes.
    message.Clear()
    if message.MergeFromString(data) != len(data):
        raise DecodeError(f"Of {len(data)} bytes not all belong to the message.")
