"""The whole stack as fixtures: simulated robot and Car, the Operator's application, and somebody who only looks."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import shutil
import subprocess
import sys
import time

import pytest
import zmq

from mtr_proto import robot_link_pb2
from mtr_simulation.stack import Stack, StackOptions

# The helpers lie beside the tests.
sys.path.append(str(pathlib.Path(__file__).parent))

TOP = pathlib.Path(__file__).resolve().parents[2]
FIRMWARE = TOP / "firmware" / "build" / "mtr_firmware_atmega2560.elf"
OUT = TOP / "out" / "test" / "system"
# A robot has it not: what its nodes log has to come out by itself.
os.environ.pop("PYTHONUNBUFFERED", None)
# What is waited for takes some seconds; a machine with much else to do takes more.
WALL_LIMIT_S = 180.0


@pytest.fixture(scope="module")
def out(request):
    """Empty folder of one test module."""
    folder = OUT / pathlib.Path(request.module.__name__).name.rpartition(".")[2]
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


@pytest.fixture(scope="module")
def stack(out):
    """Simulated robot and Car, with the firmware that is flashed, in lock-step with the application."""
    with Stack(StackOptions(out, arguments={"firmware_elf": str(FIRMWARE)})) as running:
        yield running


class Application:
    """The Operator's application as a child process on a stack."""

    def __init__(self, stack: Stack):
        self._stack = stack

    def command(self, scenario, parameters, out, *extra):
        """Command line of a run."""
        return [sys.executable, "-m", "mtr_operator", "run", scenario, "--params", str(parameters), "--out", str(out),
                "--robot", "127.0.0.1", "--subscriber-port", str(self._stack.status_port),
                "--publisher-port", str(self._stack.command_port), "--can-interface", "slcan",
                "--can-channel", str(self._stack.can_link), "--car-profile", "mtr_demo_car", *extra]

    def run(self, *arguments):
        """Run to the end."""
        return subprocess.run(self.command(*arguments), text=True, capture_output=True, check=False)

    def start(self, *arguments):
        """Start in the background."""
        return subprocess.Popen(self.command(*arguments), text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


@pytest.fixture(scope="module")
def application(stack):
    """The application on this module's stack."""
    return Application(stack)


class Observer:
    """Reads Status from the robot's port and sends nothing."""

    def __init__(self, port):
        self._context = zmq.Context()
        self._socket = self._context.socket(zmq.SUB)
        self._socket.connect(f"tcp://127.0.0.1:{port}")
        self._socket.setsockopt(zmq.SUBSCRIBE, b"")

    def wait_for(self, condition, limit_s=WALL_LIMIT_S):
        """The first Status that fulfils the condition; fails after limit_s of wall time."""
        deadline = time.monotonic() + limit_s
        status = None
        while time.monotonic() < deadline:
            if self._socket.poll(500):
                status = robot_link_pb2.Status.FromString(self._socket.recv())
                if condition(status):
                    return status
        pytest.fail(f"No Status fulfilled the condition within {limit_s} s; the last one was:\n{status}")

    def close(self):
        """Disconnect."""
        self._context.destroy(linger=0)


@pytest.fixture
def observer(stack):
    """Somebody who only looks."""
    looking = Observer(stack.status_port)
    yield looking
    looking.close()

