"""Moves a robot between random states with random faults, and samples the usage of its processes."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
import random
import threading
from typing import Dict, List, Tuple

from ..faults.course import LIFTING, WAITING, Course
from ..faults.matrix import DRIVING, LOCKSTEP, MAPPING, Cell, read_matrix
from ..faults.robot import FaultyRobot, FaultyRobotError
from .figures import Place
from .processes import Usage, below, usage_of, waiting_bytes
from .samples_file import SamplesFile

# Period of the samples in s of the robot's time, and period of the check of the robot's clock in s of wall time.
LOOK_S, POLL_S = 10.0, 0.1
# Destinations; frequent ones are repeated.
WAYS = (MAPPING, DRIVING, DRIVING, DRIVING, WAITING, LIFTING, LIFTING)
FAULT_SHARE = 0.6
# Waiting time after a fault, s of the robot's time.
AFTER_S = 3.0


class Processes(threading.Thread):
    """Samples all processes of a running robot and writes the samples to a file.

    Attributes:
        samples: (time, usage) by the name of node or program.
    """

    def __init__(self, robot: FaultyRobot, parent: int, path: pathlib.Path):
        super().__init__(name="soak", daemon=True)
        self.samples: Dict[str, List[Tuple[float, Usage]]] = {}
        self._robot, self._names, self._over = robot, below(parent), threading.Event()
        self._path = path

    def run(self) -> None:
        """Sample until `end` is called."""
        due_s = self._robot.now_s
        with SamplesFile(self._path) as file:
            while not self._over.wait(POLL_S):
                now_s = self._robot.now_s
                if now_s < due_s:
                    continue
                due_s = now_s + LOOK_S
                waiting = waiting_bytes()
                for process, name in self._names.items():
                    usage = usage_of(process, waiting)
                    if usage:
                        self.samples.setdefault(name, []).append((now_s, usage))
                        file.add(now_s, name, usage)

    def end(self) -> None:
        """Stop sampling."""
        self._over.set()
        self.join()


class Wanderer:
    """Moves the robot between random states.

    Attributes:
        places: stops with position errors.
        faults: number of faults, by name.
        failures: faults from which the robot did not recover.
    """

    def __init__(self, robot: FaultyRobot, seed: int):
        self.places: List[Place] = []
        self.faults: Dict[str, int] = {}
        self.failures: List[str] = []
        self._robot, self._course, self._random = robot, Course(robot), random.Random(seed)
        self._cells = [cell for cell in read_matrix().cells if cell.robot == LOCKSTEP]

    def go(self, until_s: float) -> bool:
        """Wander until a time of the robot; return False if the robot cannot continue before."""
        failed = 0
        while self._robot.now_s < until_s and failed < 2:
            try:
                self._turn()
                failed = 0
            except FaultyRobotError as error:
                failed += 1
                self.failures.append(str(error))
                self._robot.map_car()
            self._robot.forget()
        return failed < 2

    def _turn(self) -> None:
        self._course.to(self._random.choice(WAYS))
        if self._random.random() < FAULT_SHARE:
            self._have(self._random.choice(self._cells))
        self._course.to(WAITING)
        self._look()

    def _have(self, cell: Cell) -> None:
        robot = self._robot
        end_s = robot.begin(cell.part, cell.kind, cell.for_s, cell.amount) + cell.for_s
        self.faults[cell.fault] = self.faults.get(cell.fault, 0) + 1
        robot.wait_until(lambda: robot.now_s > end_s + AFTER_S, "the time after the fault")

    def _look(self) -> None:
        told, truth = self._robot.status, self._robot.truth.pose.pose.position
        if told.state.pose_valid:
            error_m = math.hypot(told.state.x - truth.x, told.state.y - truth.y)
            self.places.append(Place(self._robot.now_s, error_m, int(told.map_car_id)))
