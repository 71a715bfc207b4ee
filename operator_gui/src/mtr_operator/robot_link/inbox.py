"""Status messages between socket and runner: decoded, counted, in order, without repetitions or old backlog."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import dataclasses

from mtr_operator.domain.ports import LinkStatistics
from mtr_operator.domain.robot_status import Notification, RobotStatus

from .conversions import MAX_MESSAGE_BYTES, ImplausibleMessage, UndecodableMessage, decode_status

# Five seconds of Status: a slower reader needs the newest Statuses, not the old ones.
MAX_BACKLOG = 50

RESTARTED = Notification("robot_restarted", 2, "The robot has restarted; the present order was sent to it again.")


class Inbox:
    """Queue of Status messages that were received but not taken yet."""

    def __init__(self, statistics: LinkStatistics):
        self._statistics = statistics
        self._queue: collections.deque[RobotStatus] = collections.deque()
        self._robot_session_id: int | None = None
        self._newest_id = 0

    def put(self, parts: list[bytes]) -> bool:
        """Queue one ZeroMQ message; return True, without queueing it, if it repeats the Status that was taken last."""
        status = self._decoded(parts)
        if status is None:
            return False
        if status.robot_session_id != self._robot_session_id:
            status = self._begin_robot_session(status)
        elif status.id <= self._newest_id:
            return status.id == self._newest_id and not self._queue
        else:
            self._statistics.lost += status.id - self._newest_id - 1
        self._newest_id = status.id
        self._statistics.received += 1
        self._queue.append(status)
        if len(self._queue) > MAX_BACKLOG:
            self._skip_to_newest()
        return False

    def take(self) -> RobotStatus | None:
        """Return the oldest Status of the queue, None if it is empty."""
        return self._queue.popleft() if self._queue else None

    def _begin_robot_session(self, status: RobotStatus) -> RobotStatus:
        known = self._robot_session_id is not None
        self._robot_session_id = status.robot_session_id
        if not known:
            return status
        self._statistics.last_error = RESTARTED.text
        return dataclasses.replace(status, notifications=(*status.notifications, RESTARTED))

    def _skip_to_newest(self) -> None:
        self._statistics.lost += len(self._queue) - 1
        newest = self._queue[-1]
        restarted = any(RESTARTED in status.notifications for status in self._queue)
        if restarted and RESTARTED not in newest.notifications:
            newest = dataclasses.replace(newest, notifications=(*newest.notifications, RESTARTED))
        self._queue.clear()
        self._queue.append(newest)

    def _decoded(self, parts: list[bytes]) -> RobotStatus | None:
        if sum(map(len, parts)) > MAX_MESSAGE_BYTES:
            self._statistics.oversized += 1
            self._statistics.last_error = (f"A message of {sum(map(len, parts))} bytes was ignored; allowed is at most "
                                           f"{MAX_MESSAGE_BYTES} bytes.")
            return None
        try:
            if len(parts) != 1:
                raise UndecodableMessage(f"A message of {len(parts)} frames came; the robot sends one.")
            return decode_status(parts[0])
        except ImplausibleMessage as error:
            self._statistics.implausible += 1
            self._statistics.last_error = str(error)
            return None
        except UndecodableMessage as error:
            self._statistics.undecodable += 1
            self._statistics.last_error = f"A message was ignored: {error}"
            return None
