"""An application that is none: who it is to the robot, and the orders that it gives."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math
import secrets
import time
from dataclasses import dataclass
from typing import Callable, Counter, Dict, Iterator, Optional, Tuple

import zmq

from mtr_proto import robot_link_pb2 as link

# One thing after the other, never as fast as a loop would where the number is not the attack: s.
PAUSE_S = 0.02
# Newer ids than the robot's newest, by no more than it takes (mtr_dispatcher/session.py, MAX_ID_STEP).
IDS_AHEAD = 100
Keys = Optional[Tuple[bytes, bytes]]
Over = Callable[[], bool]


@dataclass(frozen=True)
class Target:
    """The robot as somebody in its network sees it.

    Attributes:
        address, status_port, command_port, pairing_port: where it listens; a pairing port of 0: no pairing.
        robot_key: its public key, which is no secret.
        keys: pairs that are not a controller's, by name, and `controller` to compare with.
        recording: what a laptop has sent to the port of Commands, as bytes on the wire.
    """

    address: str
    status_port: int
    command_port: int
    pairing_port: int
    robot_key: bytes
    keys: Dict[str, Tuple[bytes, bytes]]
    recording: bytes


class Peer:
    """Sockets of an application that is none."""

    def __init__(self, target: Target, keys: Keys, robot_key: bytes):
        self.context = zmq.Context()
        self.statuses, self.commands = self.context.socket(zmq.SUB), self.context.socket(zmq.XPUB)
        self.statuses.setsockopt(zmq.SUBSCRIBE, b"")
        for each, port in ((self.statuses, target.status_port), (self.commands, target.command_port)):
            each.setsockopt(zmq.LINGER, 0)
            each.setsockopt(zmq.RECONNECT_IVL, 10)
            if keys is not None:
                each.curve_publickey, each.curve_secretkey = keys
                each.curve_serverkey = robot_key
            each.connect(f"tcp://{target.address}:{port}")
        self.seen = link.Status()

    def close(self) -> None:
        """Disconnect."""
        self.context.destroy(0)

    def look(self) -> None:
        """Take the newest Status, where one comes."""
        while self.statuses.poll(0):
            self.seen = link.Status.FromString(self.statuses.recv())

    def is_let_in(self, limit_s: float) -> bool:
        """True when the robot subscribes to its Commands within so long; before that they go to nobody."""
        return bool(self.commands.poll(1000.0 * limit_s))


def orders(peer: Peer) -> Iterator[link.Command]:
    """Commands that would move wheels, lift and buttons, in every session that there may be, for its newest Status."""
    own = secrets.randbits(62) | 1
    for number in itertools.count(1):
        peer.look()
        seen = peer.seen
        session_id, command_id = ((own, number), (seen.session_id or 1, seen.command_id + 1 + number % IDS_AHEAD),
                                  (secrets.randbits(62) | 1, 1))[number % 3]
        # One map of the Car and one way, on which the robot drives; a new height and a new press each time.
        yield link.Command(
            session_id=session_id, id=command_id, seen_status_id=seen.id or number % 1000,
            seen_robot_time_s=seen.sent_time_s or time.time(), stop=False, map_car_id=1, max_speed_mps=1.0,
            device_height_m=1.0 + number % 2 * 0.3, resume_hold_id=seen.hold_id,
            waypoint=link.Waypoint(id=1, x=3.0, y=-2.0, heading=0.0),
            press=link.ButtonPress(id=number, buttons=[1], strength=1.0, duration_s=0.5))


def give_orders(peer: Peer, tries: Counter[str], over: Over, pause_s: float = PAUSE_S,
                limit_s: float = math.inf) -> None:
    """One after the other, s apart, until it is over or for so long."""
    end_s = time.monotonic() + limit_s
    for command in orders(peer):
        if over() or time.monotonic() > end_s:
            return
        tries["read" if peer.seen.id else "blind"] += 1
        peer.commands.send(command.SerializeToString())
        time.sleep(pause_s)
