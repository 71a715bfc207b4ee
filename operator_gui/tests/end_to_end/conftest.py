"""The command line as a person starts it, against the robot's substitute on real ports."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import subprocess
import sys
import threading

import pytest

from mtr_operator.cli import main
from mtr_operator.robot_link.client import ZmqRobotLink
from mtr_operator.robot_link.server import ConnectionServer
from mtr_operator.robot_link.substitute import RobotSubstitute

TIME_FACTOR = 40.0
PARAMETERS = "maximum_distance_m: 3.0\nminimum_distance_m: 1.0\nmeasurements_distance_m: 10.0\n"
# What takes some seconds on an idle machine takes minutes beside other jobs: these limits are for what hangs.
WALL_LIMIT_S, TEST_LIMIT_S = 280.0, 600.0


def pytest_collection_modifyitems(items):
    """Programs of their own are started here; how long that takes is a matter of the machine."""
    for item in items:
        if pathlib.Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.timeout(TEST_LIMIT_S))




class Laptop:
    """Command lines on a robot's substitute and the Car's fake.

    Attributes:
        server: the robot's two ports. folder: where everything is.
    """

    def __init__(self, server, folder):
        self.server, self.folder = server, folder
        (folder / "autolock.yaml").write_text(PARAMETERS, encoding="utf-8")

    def arguments(self, *extra, **changes):
        """Arguments of a good run to the folder `out`, with options changed by name; None leaves one out."""
        options = {"params": self.folder / "autolock.yaml", "out": self.folder / "out", "robot": "127.0.0.1",
                   "subscriber_port": self.server.subscriber_port, "publisher_port": self.server.publisher_port,
                   **changes}
        given = [(f"--{name.replace('_', '-')}", str(value)) for name, value in options.items() if value is not None]
        return ["run", "autolock", *(word for pair in given for word in pair), *map(str, extra)]

    def run(self, *extra, **changes):
        """Exit code of a run in this process."""
        return main(self.arguments(*extra, **changes))

    def start(self, *extra, **changes):
        """Run of its own process."""
        return Run([sys.executable, "-m", "mtr_operator", *self.arguments(*extra, **changes)])

    def look(self):
        """A Status of the robot, by somebody who only looks."""
        link = ZmqRobotLink("127.0.0.1", self.server.subscriber_port, self.server.publisher_port)
        link.connect()
        try:
            return link.next_status(WALL_LIMIT_S)
        finally:
            link.close()


class Run:
    """A running command line; what it says is collected."""

    def __init__(self, command):
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
        self.process = subprocess.Popen(command, text=True, encoding="utf-8", env=environment,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self._limit = threading.Timer(WALL_LIMIT_S, self.process.kill)
        self._limit.start()
        self.said = []

    def wait_until_said(self, part):
        """Read its sentences up to the one with this part."""
        for line in self.process.stderr:
            self.said.append(line)
            if part in line:
                return
        pytest.fail(f"{part!r} was not said; this was: {''.join(self.said)}")

    def finish(self):
        """Exit code, and everything that was said."""
        out, rest = self.process.communicate()
        self._limit.cancel()
        return self.process.returncode, out, "".join(self.said) + rest


@pytest.fixture
def laptop(tmp_path):
    """Laptop in reach of a robot."""
    with ConnectionServer() as server:
        robot = RobotSubstitute(server, seed=1, time_factor=TIME_FACTOR)
        robot.start()
        yield Laptop(server, pathlib.Path(tmp_path))
        robot.stop()
