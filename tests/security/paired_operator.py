"""The paired Operator of a robot under attack, on an encrypted link: his Commands are timed."""
# SPDX-License-Identifier: Apache-2.0
import secrets
import time
from typing import Any, Callable, List, Sequence

import zmq

from mtr_proto import robot_link_pb2 as link

# Wall time of a machine with much else to do.
LIMIT_S = 180.0
# Between two Commands whose way is timed, s; a key may send 500 a second.
RHYTHM_S = 0.02
# After which a Command counts as lost, s.
GIVEN_UP_S = 5.0


class NothingMoves(Exception):
    """What was waited for has not come to pass; the text says what."""


class Operator:
    """A paired controller's end of the link. seen: all Statuses that have come."""

    def __init__(self, ports: Sequence[int], keys: Any, robot_key: bytes):
        self.seen: List[link.Status] = []
        self._begin_session()
        self._context = zmq.Context()
        self._statuses, self._commands = self._context.socket(zmq.SUB), self._context.socket(zmq.PUB)
        self._statuses.setsockopt(zmq.SUBSCRIBE, b"")
        for each, port in zip((self._statuses, self._commands), ports):
            each.curve_publickey, each.curve_secretkey, each.curve_serverkey = *keys, robot_key
            each.connect(f"tcp://127.0.0.1:{port}")

    def _begin_session(self) -> None:
        self.session_id, self._id = secrets.randbits(62) | 1, 0

    def end_session(self) -> None:
        """Say goodbye; what is ordered next is of a new session."""
        self.order(end_session=True)
        self._begin_session()

    def look(self, wait_s: float) -> None:
        """Take what comes within a time."""
        end_s = time.monotonic() + wait_s
        while self._statuses.poll(max(1000.0 * (end_s - time.monotonic()), 0.0)):
            self.seen.append(link.Status.FromString(self._statuses.recv()))
            if time.monotonic() > end_s:
                break

    def order(self, is_new: bool = True, **content: Any) -> None:
        """Send a Command that answers the newest Status."""
        newest = self.seen[-1] if self.seen else link.Status()
        self._id += is_new
        self._commands.send(link.Command(session_id=self.session_id, id=self._id, seen_status_id=newest.id,
                                         seen_robot_time_s=newest.sent_time_s, **content).SerializeToString())

    def until(self, condition: Callable[[], Any], what: str, **content: Any) -> None:
        """Go on ordering until something is so; NothingMoves when it does not come to pass."""
        end_s = time.monotonic() + LIMIT_S
        self._id += 1
        while not condition():
            if time.monotonic() > end_s:
                raise NothingMoves(f"{what} has not come to pass; {self.seen[-1:]}")
            self.look(0.05)
            self.order(is_new=False, **content)

    def delay_s(self) -> float:
        """From a new Command that wants standstill to the Status that confirms it; GIVEN_UP_S when none does."""
        sent_s = time.monotonic()
        self.order(stop=True)
        again_s = sent_s + 1.0
        while not (self.seen and self.seen[-1].session_id == self.session_id and self.seen[-1].command_id == self._id):
            if time.monotonic() > sent_s + GIVEN_UP_S:
                return GIVEN_UP_S
            if self._statuses.poll(50):
                self.seen.append(link.Status.FromString(self._statuses.recv()))
            elif time.monotonic() > again_s:
                # As the application does: the same Command, for a newer Status.
                self.order(is_new=False, stop=True)
                again_s += 1.0
        taken_s = time.monotonic() - sent_s
        self.look(RHYTHM_S)
        return taken_s

    def close(self) -> None:
        """Disconnect."""
        self._context.destroy(0)
