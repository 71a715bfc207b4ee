"""The link to the robot: ZeroMQ PUB/SUB over TCP with protobuf messages."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import math
import secrets
import threading
import time
from typing import TYPE_CHECKING

import zmq

from mtr_operator.domain.errors import ConnectionFailed, LinkLost, RobotFailed
from mtr_operator.domain.ports import LinkStatistics, RobotLink
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import CarCheck, Notification, RobotStatus, WaypointResult

from .access.credentials import is_loopback, ways_to
from .access.key_chain import VIEWER, KeyChain
from .address import PUBLISHER_PORT, SUBSCRIBER_PORT, RobotAddress
from .conversions import CommandHeader, command_from_desired
from .inbox import Inbox
from .probe import probe
from .sockets import KeyRefused, LinkSockets, connect

if TYPE_CHECKING:
    from .sockets import Socket

# Longest wall time for which closing waits until the goodbye has left.
_GOODBYE_LINGER_MS = 300
_SESSION_BITS = 63
# Consecutive Statuses, about 2 s, in which the robot that we controlled reports that it has no controller.
MAX_FREE_STATUSES = 20
# Severity 3 prevents the start of a test.
VIEWER_NOTICE = Notification("viewer", 3, "This laptop is paired as a viewer: it sees the robot and cannot move it.")


class ZmqRobotLink(RobotLink):
    """Link to a robot, or to any program with the same two ports.

    Attributes:
        session_id: random per instance and never 0, so that ids of an earlier start cannot be confused with ours.
        statistics: counts since the connection was established.
    """

    def __init__(self, host: str, subscriber_port: int = SUBSCRIBER_PORT, publisher_port: int = PUBLISHER_PORT,
                 connect_timeout_s: float = 2.0, *, is_unencrypted: bool = False, chain: KeyChain | None = None):
        """is_unencrypted: the person chose a connection without encryption. chain: keys of this laptop, None for the
        system's."""
        self._is_unencrypted, self._chain = is_unencrypted, chain or KeyChain()
        self._ip = ""
        self.address = RobotAddress(host, subscriber_port, publisher_port)
        self.session_id = secrets.randbelow(2 ** _SESSION_BITS - 1) + 1
        self.statistics = LinkStatistics()
        self._timeout_s = connect_timeout_s
        self._sockets: LinkSockets | None = None
        # The thread that sends a stop differs from the thread that receives Statuses.
        self._lock = threading.RLock()
        self._inbox = Inbox(self.statistics)
        self._desired: DesiredState | None = None
        self._watches = False
        self._command_id = 0
        self._seen: RobotStatus | None = None
        self._answered: RobotStatus | None = None
        self._controls = False
        self._free_count = 0

    @property
    def is_secret(self) -> bool:
        return self._sockets is not None and self._sockets.credentials is not None

    @property
    def is_exposed(self) -> bool:
        return self._sockets is not None and not self.is_secret and not is_loopback(self._ip)

    @property
    def _is_viewer(self) -> bool:
        credentials = self._sockets.credentials if self._sockets is not None else None
        return credentials is not None and credentials.role == VIEWER

    def connect(self) -> None:
        if self._sockets is None:
            self._ip = probe(self.address, self._timeout_s)
            self._sockets = self._connected()

    def _connected(self) -> LinkSockets:
        """Return the sockets with the first matching keys; raise the first refusal if none match."""
        ways = ways_to(self.address.host, self._ip, self._is_unencrypted, self._chain)
        refusals = []
        for credentials in ways:
            try:
                return connect(self.address, self._ip, self._timeout_s, credentials)
            except KeyRefused:
                raise
            except ConnectionFailed as error:
                refusals.append(error)
        raise refusals[0]

    def next_status(self, timeout_s: float) -> RobotStatus | None:
        if self._sockets is None:
            raise ConnectionFailed("The robot is not connected.")
        subscriber = self._sockets.subscriber
        deadline = time.monotonic() + timeout_s
        while True:
            self._receive_waiting(subscriber)
            status = self._inbox.take()
            if status is not None:
                self._check_control(status)
                self._seen = self._own_view(status)
                return self._seen
            left_s = deadline - time.monotonic()
            if left_s <= 0 or not subscriber.poll(math.ceil(left_s * 1000)):
                return None

    def send(self, desired: DesiredState) -> None:
        """See RobotLink; RobotFailed if this laptop is a viewer and the state requests motion."""
        if self._is_viewer:
            if moves(desired):
                raise RobotFailed(VIEWER_NOTICE.text)
            return
        self._answer(desired, watches=False)

    def watch(self) -> None:
        if not self._is_viewer:
            self._answer(DesiredState(), watches=True)

    def _answer(self, desired: DesiredState, *, watches: bool) -> None:
        with self._lock:
            # This includes a state that only watches: older robots treat it as an order.
            if desired != self._desired:
                self._command_id += 1
                self._desired = desired
            self._watches = watches
            self._publish(desired)
            self._answered = self._seen

    def is_answered(self, status: RobotStatus) -> bool:
        return status.session_id == self.session_id and status.command_id == self._command_id

    def close(self) -> None:
        sockets = self._sockets
        if sockets is None:
            return
        with self._lock:
            self._command_id += 1
            # A session begins with its first Command: a read-only application sends nothing and has none to end.
            if self._desired is not None and not self._is_viewer:
                self._publish(DesiredState(stop=True), end_session=True)
            self._sockets = None
            sockets.publisher.close(linger=_GOODBYE_LINGER_MS)
        sockets.subscriber.close(linger=0)
        sockets.context.term()

    def _check_control(self, status: RobotStatus) -> None:
        """Continue the ids if this session's name was used elsewhere; LinkLost if the robot has ended this session."""
        if status.session_id == self.session_id:
            self._controls, self._free_count = True, 0
            # The next Command, even with equal content, must be newer than the robot's last one.
            with self._lock:
                if status.command_id > self._command_id:
                    self._command_id = status.command_id + 1
        elif self._controls and status.session_id == 0:
            self._free_count += 1
            if self._free_count > MAX_FREE_STATUSES:
                raise LinkLost("The robot no longer takes this application's Commands: another application has "
                               "controlled it meanwhile, or goodbye was said in this one's name; connect again, or "
                               "go on with a continued test.")

    def _own_view(self, status: RobotStatus) -> RobotStatus:
        """Return the Status without confirmations of another session, whose ids count from 1 as well."""
        if status.controller_name and not self.is_secret:
            # A name on an unencrypted link is not authenticated.
            status = dataclasses.replace(status, controller_name="")
        if self._is_viewer:
            status = dataclasses.replace(status, notifications=(*status.notifications, VIEWER_NOTICE))
        if status.session_id in (0, self.session_id):
            return status
        return dataclasses.replace(status, controlled_by_other=True, command_id=0, waypoint_id=0,
                                   waypoint_result=WaypointResult.NONE, waypoint_message="", waypoint_problems=(),
                                   presses=(), map_car_id=0,
                                   car_check=status.car_check and CarCheck())

    def _receive_waiting(self, subscriber: Socket) -> None:
        while True:
            try:
                parts = subscriber.recv_multipart(zmq.NOBLOCK)
            except zmq.Again:
                return
            repeated = self._inbox.put(parts)
            # The robot repeats an unanswered Status; one that the runner is still processing has no answer yet.
            with self._lock:
                if repeated and self._desired is not None and self._answered is self._seen:
                    self._publish(self._desired)

    def _publish(self, desired: DesiredState, end_session: bool = False) -> None:
        seen = self._seen
        header = CommandHeader(self.session_id, self._command_id, time.monotonic(),
                               seen_status_id=seen.id if seen else None,
                               seen_robot_time_s=_time_of_sending(seen) if seen else None, end_session=end_session,
                               watches=self._watches and not end_session)
        payload = command_from_desired(desired, header).SerializeToString()
        with self._lock:
            if self._sockets is None:
                raise ConnectionFailed("The robot is not connected.")
            self._sockets.publisher.send(payload)


def moves(desired: DesiredState) -> bool:
    """Return True if the state requests any motion."""
    return any((desired.waypoint, desired.press, desired.map_car_id, desired.check_car_id,
                desired.key_height_m is not None))


def _time_of_sending(status: RobotStatus) -> float:
    return status.stamp_s if math.isnan(status.sent_s) else status.sent_s
