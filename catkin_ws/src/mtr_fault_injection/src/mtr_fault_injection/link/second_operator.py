"""Foreign application that sends Commands or garbage to a robot with another Operator."""
# SPDX-License-Identifier: Apache-2.0
import random
import secrets
import threading

import zmq

from mtr_proto import robot_link_pb2 as link

from ..parts import Kind

POLL_MS = 100
# Period of garbage messages, about 200 per second.
GARBAGE_PERIOD_S = 0.005
MAX_GARBAGE_BYTES = 300


class SecondOperator:
    """Sends from a thread until `end`; only works on an unencrypted link, because it has no key."""

    def __init__(self, kind: Kind, address: str, status_port: int, command_port: int, seed: int):
        self._random, self._over = random.Random(seed), threading.Event()
        # The context of the process is used, because the threads of one context per fault would leak memory.
        context = zmq.Context.instance()
        self._statuses, self._commands = context.socket(zmq.SUB), context.socket(zmq.PUB)
        # Without a subscription, unread Statuses do not accumulate while garbage is sent.
        if kind is Kind.CLAIM:
            self._statuses.setsockopt(zmq.SUBSCRIBE, b"")
        self._statuses.connect(f"tcp://{address}:{status_port}")
        self._commands.connect(f"tcp://{address}:{command_port}")
        work = self._claim if kind is Kind.CLAIM else self._babble
        self._thread = threading.Thread(target=work, name="second Operator", daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Stop sending."""
        self._over.set()
        self._thread.join()
        self._statuses.close(linger=0)
        self._commands.close(linger=0)

    def _claim(self) -> None:
        command = link.Command(session_id=secrets.randbits(63) | 1, id=1,
                               waypoint=link.Waypoint(id=1, x=5.0, y=5.0, heading=0.0))
        while not self._over.is_set():
            if self._statuses.poll(POLL_MS):
                status = link.Status.FromString(self._statuses.recv())
                command.seen_status_id, command.seen_robot_time_s = status.id, status.sent_time_s
                self._commands.send(command.SerializeToString())

    def _babble(self) -> None:
        while not self._over.wait(GARBAGE_PERIOD_S):
            self._commands.send(bytes(self._random.getrandbits(8)
                                      for _ in range(self._random.randrange(MAX_GARBAGE_BYTES))))
