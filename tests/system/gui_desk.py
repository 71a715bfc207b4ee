"""A laptop on a desk of its own: an X server with a window manager, and the robot's substitute on real ports."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import pathlib
import subprocess
import sys
import time
from typing import Iterator, Optional, Type

from mtr_operator.robot_link.server import ConnectionServer
from mtr_operator.robot_link.substitute import RobotSubstitute
from mtr_operator.robot_link.virtual.robot import VirtualRobot, VirtualWorld

SCREEN = "-screen 0 1366x768x24 -nolisten tcp"
MANAGER = pathlib.Path(__file__).with_name("window_manager.xml")
# Virtual seconds per second: a short test takes seconds, and its mapping long enough for a person to stop it.
TIME_FACTOR = 10.0
WORLD = VirtualWorld(mapping_s=60.0)
_START_LIMIT_S = 20.0
# Wall time from one Status to the next, shorter than a silence that a window tells.
_SLOW_PERIOD_S = 0.8


def on_a_desk(script: pathlib.Path, folder: pathlib.Path) -> "subprocess.CompletedProcess[str]":
    """Run a session on an X server of 1366x768 pixels; folder: for its files."""
    return subprocess.run(["xvfb-run", "-a", "-s", SCREEN, sys.executable, str(script), str(folder)], text=True,
                          capture_output=True, check=False, env=dict(os.environ, QT_QPA_PLATFORM="xcb"))


@contextlib.contextmanager
def window_manager() -> Iterator[None]:
    """Context with a window manager that has taken the screen over."""
    with subprocess.Popen(["jwm", "-f", str(MANAGER)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        try:
            deadline = time.monotonic() + _START_LIMIT_S
            # Only a window manager tells how many desktops there are.
            while subprocess.run(["xdotool", "get_num_desktops"], capture_output=True, check=False).returncode:
                if time.monotonic() > deadline or process.poll() is not None:
                    raise TimeoutError("The window manager did not start.")
                time.sleep(0.05)
            yield
        finally:
            process.terminate()


class Robot:
    """A substitute that can be switched off and on again; it has the same ports then, and is another start of itself.

    Attributes: status_port, command_port.
    """

    def __init__(self, kind: Type[VirtualRobot] = VirtualRobot) -> None:
        self._kind = kind
        self.status_port = self.command_port = 0
        self._starts = 0
        self._server: Optional[ConnectionServer] = None
        self._substitute: Optional[RobotSubstitute] = None

    def switch_on(self) -> None:
        """Serve."""
        self._starts += 1
        server = self._server = ConnectionServer(self.status_port, self.command_port).__enter__()
        self.status_port, self.command_port = server.subscriber_port, server.publisher_port
        self._substitute = RobotSubstitute(server, time_factor=TIME_FACTOR, robot=self._kind(self._starts, WORLD))
        self._substitute.start()

    @contextlib.contextmanager
    def slowly(self) -> Iterator[None]:
        """Context in which hardly any virtual time passes, however long it takes; the robot is heard all the same."""
        substitute = self._substitute
        period_s, substitute.period_s = substitute.period_s, _SLOW_PERIOD_S
        try:
            yield
        finally:
            substitute.period_s = period_s

    def switch_off(self) -> None:
        """End; safe to call twice."""
        substitute, self._substitute = self._substitute, None
        if substitute is not None:
            substitute.stop()
        server, self._server = self._server, None
        if server is not None:
            server.__exit__(None, None, None)
