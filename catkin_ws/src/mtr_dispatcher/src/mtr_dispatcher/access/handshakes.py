"""What happens to connections before their first message, from ZeroMQ's monitor of a socket."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, List

import zmq
from zmq.utils.monitor import recv_monitor_message

NOT_ENCRYPTED, GONE = "not encrypted for this robot", "gone before the end of the handshake"
# A peer without a key, or with the wrong key of the robot; an unknown key of its own was counted by the authenticator.
# One that finds by itself that the robot speaks another language may be gone before the robot has read its greeting;
# so is one that only looks whether the port is open.
_WORDS = {zmq.EVENT_HANDSHAKE_FAILED_PROTOCOL: NOT_ENCRYPTED, zmq.EVENT_HANDSHAKE_FAILED_NO_DETAIL: GONE}
# ZeroMQ waits, with everybody's messages, while some 2000 events are not taken (measured, 4.3.4): the node takes these
# 50 times a second, more than a network brings.
PER_TURN = 500


class HandshakeWatch:
    """Counts the connections to one socket that never became encrypted ones for this robot."""

    def __init__(self, socket: Any):
        self._monitor = socket.get_monitor_socket(sum(_WORDS))

    def failed(self) -> List[str]:
        """One word for each since the last call, at most PER_TURN."""
        words: List[str] = []
        while len(words) < PER_TURN:
            try:
                event = recv_monitor_message(self._monitor, zmq.NOBLOCK)["event"]
            except zmq.Again:
                break
            words.append(_WORDS[event])
        return words
