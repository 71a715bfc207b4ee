"""Sends Commands alternately through a plain and an encrypted link, as an application would.

Usage: python -m mtr_benchmarks.link.sender PLAIN_PORT ENCRYPTED_PORT COUNT PUBLIC SECRET SERVER
"""
# SPDX-License-Identifier: Apache-2.0
import struct
import sys
import time
from typing import Any, List

import zmq

# Length of a Command with a waypoint and a press; the message begins with its time of sending.
COMMAND_BYTES, STAMP = 120, struct.Struct("<q")
# Period on each link, the shortest of an application, s.
RHYTHM_S = 0.01
LINGER_MS = 1000


def main(arguments: List[str]) -> None:
    """Send the given number of Commands through each link."""
    ports, count, keys = arguments[:2], int(arguments[2]), [key.encode("ascii") for key in arguments[3:]]
    context = zmq.Context()
    # An XPUB socket is notified of subscriptions; a PUB socket does not know whether its messages arrive.
    sockets: List[Any] = [context.socket(zmq.XPUB) for _ in ports]
    sockets[1].curve_publickey, sockets[1].curve_secretkey, sockets[1].curve_serverkey = keys
    for socket, port in zip(sockets, ports):
        socket.connect(f"tcp://127.0.0.1:{port}")
        socket.recv()
    for number in range(count):
        # The order alternates, because the first message finds the processor asleep.
        for socket in sockets if number % 2 else reversed(sockets):
            socket.send(STAMP.pack(time.monotonic_ns()).ljust(COMMAND_BYTES, b"x"))
            time.sleep(RHYTHM_S / len(sockets))
    context.destroy(LINGER_MS)


if __name__ == "__main__":
    main(sys.argv[1:])
