"""An application that sends Commands through two links by turns: a plain one and an encrypted one.

Usage: python -m mtr_benchmarks.link.sender PLAIN_PORT ENCRYPTED_PORT COUNT PUBLIC SECRET SERVER
"""
# SPDX-License-Identifier: Apache-2.0
import struct
import sys
import time
from typing import Any, List

import zmq

# As long as a Command with a waypoint and a press; what it begins with is when it was sent.
COMMAND_BYTES, STAMP = 120, struct.Struct("<q")
# Through each link as often as an application sends at most, s.
RHYTHM_S = 0.01
LINGER_MS = 1000


def main(arguments: List[str]) -> None:
    """Send so many through each."""
    ports, count, keys = arguments[:2], int(arguments[2]), [key.encode("ascii") for key in arguments[3:]]
    context = zmq.Context()
    # An XPUB hears that somebody listens; a PUB would not know whether its words get anywhere.
    sockets: List[Any] = [context.socket(zmq.XPUB) for _ in ports]
    sockets[1].curve_publickey, sockets[1].curve_secretkey, sockets[1].curve_serverkey = keys
    for socket, port in zip(sockets, ports):
        socket.connect(f"tcp://127.0.0.1:{port}")
        socket.recv()
    for number in range(count):
        # Whoever is first finds the processor asleep.
        for socket in sockets if number % 2 else reversed(sockets):
            socket.send(STAMP.pack(time.monotonic_ns()).ljust(COMMAND_BYTES, b"x"))
            time.sleep(RHYTHM_S / len(sockets))
    context.destroy(LINGER_MS)


if __name__ == "__main__":
    main(sys.argv[1:])
