"""What happens to connections before their first message, from ZeroMQ's monitor of a socket."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, List

import zmq
from zmq.utils.monitor import recv_monitor_message

# A peer without a key, or with the wrong key of the robot; an unknown key of its own was counted by the authenticator.
_FAILED = zmq.EVENT_HANDSHAKE_FAILED_PROTOCOL
PER_TURN = 100


class HandshakeWatch:
    """Counts the connections to one socket that were not encrypted, or not for this robot."""

    def __init__(self, socket: Any):
        self._monitor = socket.get_monitor_socket(_FAILED)
        # A flood of strangers fills the queue and is dropped there.
        self._socket = socket

    def failed(self) -> List[str]:
        """One word for each since the last call, at most PER_TURN."""
        words: List[str] = []
        while len(words) < PER_TURN:
            try:
                recv_monitor_message(self._monitor, zmq.NOBLOCK)
            except zmq.Again:
                break
            words.append("no encryption")
        return words
