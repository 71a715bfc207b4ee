"""Memory of the window over a day of tests, one after the other, at the speed at which this machine can measure them.

The robot is in this process and answers at once: hours of its time, with ten Statuses a second, pass in minutes. It
logs a sentence now and then, and rests after each test. Everything of the application that grows with Statuses, lines,
events and tests does so as it does in a day, and more, for a person measures fewer tests; what grows with wall time
alone does not.
"""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import itertools
import pathlib
from typing import Any, Iterator, List, NamedTuple, Tuple

from scipy.stats import theilslopes

from mtr_operator.domain.robot_status import LogMessage, RobotStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.gui.app import Application
from mtr_operator.gui.report_writer import ReportWriter
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_operator.robot_link.virtual.robot import VirtualRobot
from mtr_operator.station.connection import SIMULATED, CanChoice, Connection, LinkOpener, RobotChoice
from mtr_operator.station.readiness import Phase

from .robot import seen
from .window import SIZE, memory_mib, until

# Virtual seconds per second: more than a busy machine gives, so that the window still gets its turn.
TIME_FACTOR = 400.0
# Memory is looked at so often; the first look comes when all that is made once is made. Each comes when a test ended
# and its files are written, for a picture of the protocol takes 50 MiB as long as it is made.
LOOKS = 24
LIMIT_S = 1800.0
SEEN_EVERY = 50
# A sentence of the log in 10 s, and a minute between two tests: robot time. With the changes of the locks and what the
# test does that is more than the list of events keeps.
LOGGED_EVERY = 100
REST_S = 60.0
_PARAMETERS = {"angle_between_radials_deg": 30.0, "method": "scan"}
_S_PER_HOUR = 3600.0


class DayFigures(NamedTuple):
    """hours: of robot time. tests: measured to their end. events: of the list of events, those that it forgot included.
    memory_mib: at each look, evenly over the hours."""

    hours: float
    tests: int
    events: int
    memory_mib: List[float]

    @property
    def slope_mib_per_h(self) -> Tuple[float, float, float]:
        """Of the memory from the first look to the last, and the ends of its 95 % interval.

        The median of the slopes between any two looks, and the interval by their ranks (Sen 1968, Journal of the
        American Statistical Association 63, 1379): one odd look says nothing.
        """
        looks = len(self.memory_mib)
        found = theilslopes(self.memory_mib, [self.hours * (number + 1) / looks for number in range(looks)], 0.95)
        return float(found[0]), float(found[2]), float(found[3])

    @property
    def growth_mib(self) -> float:
        """From the first look to the last."""
        return self.slope_mib_per_h[0] * self.hours * (1.0 - 1.0 / len(self.memory_mib))


class QuickRobot(VirtualRobot):
    """Sees now and then: what it sees takes longer to make up than all else, and the newest alone is shown. Logs."""

    def status(self) -> RobotStatus:
        """See VirtualRobot."""
        told = super().status()
        if told.id % LOGGED_EVERY == 0:
            said = f"Wheel slip of {told.id % 97 / 100.0:.2f} m was corrected."
            told = dataclasses.replace(told, log=(LogMessage(told.id, told.stamp_s, 1, "localization", said),))
        return told if told.id % SEEN_EVERY else dataclasses.replace(told, surroundings=seen(told))


class QuickOpener(LinkOpener):
    """One robot, which lives on from session to session."""

    def __init__(self) -> None:
        self._robot = QuickRobot(1)
        self._sessions: Iterator[int] = itertools.count(1)

    @property
    def time_s(self) -> float:
        """Of the robot."""
        return self._robot.time_s

    def robot(self, choice: RobotChoice) -> Any:
        """See LinkOpener."""
        return FakeRobotLink(time_factor=TIME_FACTOR, robot=self._robot, session_id=next(self._sessions))


def use_for_hours(folder: pathlib.Path, hours: float) -> DayFigures:
    """Measure one test after the other for hours of robot time; the Qt application has to be there."""
    opener = QuickOpener()
    application = Application(folder / "settings.json", opener)
    try:
        return _use(application, opener, folder, hours)
    finally:
        application.close()


def _use(application: Application, opener: QuickOpener, folder: pathlib.Path, hours: float) -> DayFigures:
    application.open()
    store, flow = application.flow.store, application.flow
    store.settings = dataclasses.replace(store.settings, result_folder=folder / "results",
                                         progress_folder=folder / "progress", has_sounds=False)
    flow.connecting.connect_to(Connection(RobotChoice("127.0.0.1"), CanChoice(SIMULATED)))
    until(lambda: flow.model.robot is not None)
    window: Any = application.window
    window.resize(SIZE)
    scenario = SCENARIOS["key_press"]
    parameters = scenario.parameters_type.from_mapping({**scenario.parameters_type.proposed(), **_PARAMETERS})
    begun_s, tests = opener.time_s, 0
    memory: List[float] = []
    flow.start(scenario, parameters)
    while len(memory) < LOOKS:
        until(lambda: flow.model.phase is not Phase.MEASURING, LIMIT_S)
        if flow.model.phase is not Phase.FINISHED:
            raise RuntimeError(f"The test ended: {flow.model.trouble}")
        tests += 1
        flow.to_welcome()
        if opener.time_s >= begun_s + (len(memory) + 1) * hours * _S_PER_HOUR / LOOKS:
            ReportWriter.finish_all()
            memory.append(memory_mib())
        _rest(opener)
        flow.start(scenario, parameters)
    flow.stop()
    ReportWriter.finish_all()
    return DayFigures(hours, tests, flow.model.events.count, memory)


def _rest(opener: QuickOpener) -> None:
    """The robot stands, and its Statuses are answered."""
    end_s = opener.time_s + REST_S
    until(lambda: opener.time_s >= end_s, LIMIT_S)
