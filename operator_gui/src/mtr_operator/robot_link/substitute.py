"""Substitute of the robot for development: a ZeroMQ server on both ports that simulates the robot's behaviour.

Usage: python -m mtr_operator.robot_link.substitute [--subscriber-port N] [--publisher-port N]
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import math
import sys
import threading
import time

import zmq

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.robot_status import LINK_LOST_CODE

from .address import PUBLISHER_PORT, SUBSCRIBER_PORT
from .conversions import (
    MAX_MESSAGE_BYTES,
    UndecodableMessage,
    decode_command,
    desired_from_command,
    status_message_from,
)
from .server import LOOPBACK, ConnectionServer
from .virtual.robot import DEFAULT_WORLD, STATUS_PERIOD_S, VirtualRobot, VirtualWorld

# Virtual time without a Command after which the robot stops and another session may take over, and its minimum in wall
# time: a busy laptop answers late, at any rate of virtual time.
_SILENCE_LIMIT_S = 1.0
_MIN_SILENCE_WALL_S = 0.3


class RobotSubstitute:
    """Virtual robot behind the two ports of a ConnectionServer; run() serves until stop(), start() does so in a thread.

    time_factor: virtual seconds per second of wall time. robot: replaces the robot of the world's seed. Attributes:
    period_s: wall time between Statuses; may be changed while it serves. rejected: messages.
    """

    def __init__(self, server: ConnectionServer, seed: int = 1, time_factor: float = 1.0,
                 world: VirtualWorld = DEFAULT_WORLD, *, robot: VirtualRobot | None = None):
        self.server = server
        self.rejected = 0
        self._robot = robot or VirtualRobot.started(seed, world)
        self.period_s = STATUS_PERIOD_S / time_factor
        self._silence_limit_wall_s = max(_SILENCE_LIMIT_S / time_factor, _MIN_SILENCE_WALL_S)
        self._stopping = threading.Event()
        self._thread: threading.Thread | None = None
        self._session_id = 0
        self._newest_command_s = -math.inf
        # Number of Statuses since the newest Command.
        self._unanswered = math.inf

    def start(self) -> None:
        """Serve in a thread; the server must be open."""
        self._thread = threading.Thread(target=self.run, name="robot-substitute", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """End run() and the thread."""
        self._stopping.set()
        if self._thread is not None:
            self._thread.join()
            self._thread = None

    def run(self) -> None:
        """Receive Commands, advance time, send Status."""
        deadline = time.monotonic()
        while not self._stopping.is_set():
            # A late cycle is not compensated: virtual time runs slower on a loaded machine.
            deadline = max(deadline + self.period_s, time.monotonic())
            self._take_commands_until(deadline)
            if self._is_silent(time.monotonic()):
                self._robot.halt()
            self._robot.step()
            self._unanswered += 1
            message = status_message_from(self._robot.status())
            message.rejected_messages = self.rejected
            if message.session_id and self._is_silent(time.monotonic()):
                message.notifications.add(code=LINK_LOST_CODE, severity=3, text="The application has fallen silent.")
            self.server.status_socket.send(message.SerializeToString())

    def _is_silent(self, now: float) -> bool:
        """Return True if the current session is silent; delays of this program itself do not count as silence."""
        return now - self._newest_command_s > self._silence_limit_wall_s and \
            self._unanswered * STATUS_PERIOD_S > _SILENCE_LIMIT_S

    def _take_commands_until(self, deadline: float) -> None:
        socket = self.server.command_socket
        while socket.poll(max(0, math.ceil((deadline - time.monotonic()) * 1000))):
            self._take(socket.recv_multipart(zmq.NOBLOCK))

    def _take(self, parts: list[bytes]) -> None:
        now = time.monotonic()
        try:
            if len(parts) != 1 or len(parts[0]) > MAX_MESSAGE_BYTES:
                raise UndecodableMessage("not one frame of at most 64 KiB")
            command = decode_command(parts[0])
        except UndecodableMessage:
            self.rejected += 1
            return
        if command.watches:
            return
        if command.session_id != self._session_id and not self._is_silent(now):
            self.rejected += 1
            return
        if command.end_session:
            self._robot.leave()
            self._newest_command_s = -math.inf
            self._unanswered = math.inf
            return
        self._session_id, self._newest_command_s, self._unanswered = command.session_id, now, 0
        self._robot.take(command.session_id, command.id, desired_from_command(command))


def main(arguments: list[str] | None = None) -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(description="Substitute of the robot, to develop the Operator's application.")
    parser.add_argument("--subscriber-port", type=int, default=SUBSCRIBER_PORT, help="Status, default %(default)s")
    parser.add_argument("--publisher-port", type=int, default=PUBLISHER_PORT, help="Command, default %(default)s")
    parser.add_argument("--bind", default=LOOPBACK, metavar="ADDRESS", help="address to listen on, default %(default)s")
    parser.add_argument("--time-factor", type=float, default=1.0, help="virtual s per s, default %(default)g")
    parser.add_argument("--seed", type=int, default=1, help="start position, default %(default)s")
    options = parser.parse_args(arguments)
    if not 0.1 <= options.time_factor <= 100:
        parser.error(f"--time-factor is {options.time_factor:g}; allowed is 0.1 to 100.")
    try:
        with ConnectionServer(options.subscriber_port, options.publisher_port, options.bind) as server:
            print(f"Robot substitute: Status on {server.subscriber_port}, Command on {server.publisher_port}. "
                  "Ctrl-C ends it.", flush=True)
            RobotSubstitute(server, options.seed, options.time_factor).run()
    except OperatorError as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        pass
    return 0


if __name__ == "__main__":
    sys.exit(main())
