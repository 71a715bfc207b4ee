"""Memory of the window over a day of tests, one after the other, at the highest speed of this machine.

The robot is in this process and answers at once: hours of its time, with ten Statuses a second, pass in minutes. It
logs a message regularly and rests after each test. Memory that grows with Statuses, lines, events and tests grows at
least as in a day, because a person runs fewer tests. Memory that grows with wall time alone does not grow.
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

# Virtual seconds per second: more than a busy machine reaches, so that the window is still processed.
TIME_FACTOR = 400.0
# Number of memory samples. The first one follows all one-time allocations. Each one is taken after a test has ended and
# its files are written, because rendering a picture of the report needs 50 MiB temporarily.
LOOKS = 24
LIMIT_S = 1800.0
SEEN_EVERY = 50
# One log message in 10 s and a minute between two tests, robot time. With lock changes and the test's own events, this
# exceeds the capacity of the list of events.
LOGGED_EVERY = 100
REST_S = 60.0
_PARAMETERS = {"angle_between_radials_deg": 30.0, "method": "scan"}
_S_PER_HOUR = 3600.0


class DayFigures(NamedTuple):
    """Figures of a day.

    Attributes:
        hours: robot time.
        tests: completed tests.
        events: number of events, including those removed from the list.
        memory_mib: memory at each sample, equally spaced over the hours.
    """

    hours: float
    tests: int
    events: int
    memory_mib: List[float]

    @property
    def slope_mib_per_h(self) -> Tuple[float, float, float]:
        """Slope of the memory from the first sample to the last, and its 95 % interval.

        It is the median of the slopes between all pairs of samples; the interval is based on their ranks. A single
        outlier has no effect. Source: Sen 1968, Journal of the American Statistical Association 63, 1379.
        """
        looks = len(self.memory_mib)
        found = theilslopes(self.memory_mib, [self.hours * (number + 1) / looks for number in range(looks)], 0.95)
        return float(found[0]), float(found[2]), float(found[3])

    @property
    def growth_mib(self) -> float:
        """Growth from the first sample to the last."""
        return self.slope_mib_per_h[0] * self.hours * (1.0 - 1.0 / len(self.memory_mib))


class QuickRobot(VirtualRobot):
    """Virtual robot that logs, and sends surroundings only occasionally: they are expensive to compute, and only the
    newest are shown."""

    def status(self) -> RobotStatus:
        """See VirtualRobot."""
        told = super().status()
        if told.id % LOGGED_EVERY == 0:
            said = f"Wheel slip of {told.id % 97 / 100.0:.2f} m was corrected."
            told = dataclasses.replace(told, log=(LogMessage(told.id, told.stamp_s, 1, "localization", said),))
        return told if told.id % SEEN_EVERY else dataclasses.replace(told, surroundings=seen(told))


class QuickOpener(LinkOpener):
    """Opens links to one robot, which persists over sessions."""

    def __init__(self) -> None:
        self._robot = QuickRobot(1)
        self._sessions: Iterator[int] = itertools.count(1)

    @property
    def time_s(self) -> float:
        """Time of the robot."""
        return self._robot.time_s

    def robot(self, choice: RobotChoice) -> Any:
        """See LinkOpener."""
        return FakeRobotLink(time_factor=TIME_FACTOR, robot=self._robot, session_id=next(self._sessions))


def use_for_hours(folder: pathlib.Path, hours: float) -> DayFigures:
    """Measure one test after the other for hours of robot time; requires an existing Qt application."""
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
    """Let the robot rest while its Statuses are answered."""
    end_s = opener.time_s + REST_S
    until(lambda: opener.time_s >= end_s, LIMIT_S)
