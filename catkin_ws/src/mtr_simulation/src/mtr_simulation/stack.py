"""The simulated robot and Car as one child process, on ports of its own."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import pathlib
import secrets
import signal
import socket
import subprocess
import time
from dataclasses import dataclass
from typing import Dict, List, Optional, Set, Tuple

START_LIMIT_S = 60.0
STOP_LIMIT_S = 20.0
POLL_S = 0.1
# Its package depends on this one, because it starts the simulator; users of a stack depend on both.
SIM_LAUNCH = ("mtr_bringup", "sim.launch")
LISTENING_PORTS = range(20000, 32000)
# Whatever ends the process that has started the robot ends the robot, as Ctrl-C does (setpriv(1), of Debian's base).
ENDS_WITH_STARTER = ("setpriv", "--pdeathsig", "INT")


class StackError(Exception):
    """The stack did not start; the text says where to look."""


@dataclass(frozen=True)
class StackOptions:
    """What a simulated stack is started with.

    Attributes:
        folder: where its log, the CAN adapter's link and the true events go.
        seed: of every random number.
        real_time_factor: simulated seconds per second, 0 for as fast as the control loop allows.
        lockstep_operator: time waits for the Operator's application; None: the launch file does not know of that.
        rviz: show the robot.
        arguments: further arguments of sim.launch.
        variables: further variables of the nodes' environment.
        launch: package and name of the launch file, whose arguments are those of sim.launch as far as they are given.
    """

    folder: pathlib.Path
    seed: int = 1
    real_time_factor: float = 0.0
    lockstep_operator: Optional[bool] = True
    rviz: bool = False
    arguments: Optional[Dict[str, str]] = None
    variables: Optional[Dict[str, str]] = None
    launch: Tuple[str, str] = SIM_LAUNCH


# A port that was given is not listened on at once.
_GIVEN: Set[int] = set()


def free_port() -> int:
    """A TCP port of the loopback interface that nobody listens on now, and that this process was not given before.

    Below the range from which the system takes ports for outgoing connections: the nodes' own connections could
    otherwise take it before the node that is to listen there.
    """
    while True:
        port = secrets.choice(LISTENING_PORTS)
        if port in _GIVEN:
            continue
        with socket.socket() as probe, contextlib.suppress(OSError):
            probe.bind(("127.0.0.1", port))
            _GIVEN.add(port)
            return port


class Stack:
    """roslaunch of a simulated robot; use as a context manager, in a thread that lasts as long as the robot shall.

    Attributes:
        status_port: where the robot publishes Status.
        command_port: where it receives Commands.
        can_link: path of the Car's CAN adapter.
        master_uri: of its ROS master.
    """

    def __init__(self, options: StackOptions):
        self.options = options
        folder = options.folder.resolve()
        self.can_link = folder / "can"
        self.log = folder / "stack.log"
        self.status_port, self.command_port, self._master_port = free_port(), free_port(), free_port()
        self.master_uri = f"http://127.0.0.1:{self._master_port}"
        self._process: Optional[subprocess.Popen[bytes]] = None

    def __enter__(self) -> "Stack":
        self.log.parent.mkdir(parents=True, exist_ok=True)
        with self.log.open("wb") as log:
            environment = {**self.environment(), **(self.options.variables or {})}
            process = subprocess.Popen(self._command(), env=environment, stdout=log, stderr=subprocess.STDOUT,
                                       start_new_session=True)
        self._process = process
        try:
            self._wait_until_reachable(process)
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    @property
    def pid(self) -> int:
        """Process of roslaunch, whose children the nodes are; StackError when it does not run."""
        if self._process is None:
            raise StackError("The simulated robot does not run.")
        return self._process.pid

    def environment(self) -> Dict[str, str]:
        """Environment for commands that talk to this stack's ROS master."""
        return dict(os.environ, ROS_MASTER_URI=self.master_uri, ROS_IP="127.0.0.1",
                    ROS_HOME=str(self.log.parent / "ros"))

    def stop(self) -> None:
        """End it as Ctrl-C does; what does not end in time is killed."""
        process, self._process = self._process, None
        if process is None:
            return
        process.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(STOP_LIMIT_S)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    def _command(self) -> List[str]:
        options = self.options
        arguments = {
            "seed": str(options.seed), "real_time_factor": str(options.real_time_factor),
            "rviz": str(options.rviz).lower(),
            "car_port_link": str(self.can_link), "truth_dir": str(self.log.parent),
            "status_port": str(self.status_port), "command_port": str(self.command_port),
            **(options.arguments or {}),
        }
        if options.lockstep_operator is not None:
            arguments["lockstep_operator"] = str(options.lockstep_operator).lower()
        return [*ENDS_WITH_STARTER, "roslaunch", "-p", str(self._master_port), *options.launch,
                *(f"{name}:={value}" for name, value in arguments.items())]

    def _wait_until_reachable(self, process: "subprocess.Popen[bytes]") -> None:
        deadline = time.monotonic() + START_LIMIT_S
        while not (self.can_link.exists() and self._listens(self.status_port) and self._listens(self.command_port)):
            if process.poll() is not None:
                raise StackError(f"The simulated robot ended while starting; see {self.log}.")
            if time.monotonic() > deadline:
                raise StackError(f"The simulated robot did not start within {START_LIMIT_S:.0f} s; see {self.log}.")
            time.sleep(POLL_S)

    @staticmethod
    def _listens(port: int) -> bool:
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", port)) == 0
