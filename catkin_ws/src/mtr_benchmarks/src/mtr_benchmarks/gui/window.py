"""Operates and measures the complete application in this process; the robot is in another one, behind the real link."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import os
import pathlib
import time
from typing import Any, Callable, Dict, List, NamedTuple, Optional

from PyQt5.QtCore import QEvent, QEventLoop, QSize, Qt
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import QApplication

from mtr_operator.domain.robot_status import Mode
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.gui.app import Application
from mtr_operator.gui.pictures.picture_view import PictureView
from mtr_operator.robot_link.client import ZmqRobotLink
from mtr_operator.station.connection import SIMULATED, CanChoice, Connection, LinkOpener, RobotChoice

SIZE = QSize(1360, 860)
# Limit for mapping the virtual Car, in wall time; it is not measured.
READY_LIMIT_S = 180.0
STOP_PAUSE_S = 0.15
_PAGE_BYTES = os.sysconf("SC_PAGE_SIZE")
_MIB = 2.0 ** 20


class Times(NamedTuple):
    """Duration of each part, and number of clicks on Stop."""

    rest_s: float = 20.0
    measuring_s: float = 60.0
    stops: int = 100


class Watch:
    """Times of events, on the monotonic clock.

    Attributes:
        came_s: arrival of each Status, by its id. stops_s: when a stop had left the socket. paints_s: ends of
            paintings. picture_s: time from a Status to the end of the first painting that shows it.
    """

    def __init__(self) -> None:
        self.came_s: Dict[int, float] = {}
        self.stops_s: List[float] = []
        self.paints_s: List[float] = []
        self.picture_s: List[float] = []
        self.newest_id: Callable[[], int] = lambda: 0
        self._shown_id = 0

    def painted(self) -> None:
        """Record a painting of the picture."""
        now_s, newest = time.monotonic(), self.newest_id()
        self.paints_s.append(now_s)
        if newest != self._shown_id and newest in self.came_s:
            self.picture_s.append(now_s - self.came_s[newest])
        self._shown_id = newest


class WatchedOpener(LinkOpener):
    """Opens links that record the times of messages."""

    def __init__(self, watch: Watch) -> None:
        self._watch = watch

    def robot(self, choice: RobotChoice) -> Any:
        """See LinkOpener."""
        watch = self._watch

        class Link(ZmqRobotLink):
            """Link of the application."""

            def next_status(self, timeout_s: float) -> Any:
                status = super().next_status(timeout_s)
                if status is not None:
                    watch.came_s[status.id] = time.monotonic()
                return status

            def send(self, desired: Any) -> None:
                super().send(desired)
                if desired.stop:
                    watch.stops_s.append(time.monotonic())
        return Link(choice.host, choice.subscriber_port, choice.publisher_port)


class WindowFigures(NamedTuple):
    """Figures of the window; times in s, processor time in cores, memory in MiB."""

    stop_s: List[float]
    picture_s: List[float]
    frames_per_s: float
    rest_cores: float
    measuring_cores: float
    memory_mib: float
    memory_growth_mib: float


def use_window(folder: pathlib.Path, ports: List[int], times: Times) -> WindowFigures:
    """Connect, rest, measure and stop; requires an existing Qt application. folder: folder of settings and results."""
    watch = Watch()
    painted = PictureView.paintEvent

    def paint(view: PictureView, event: Any) -> None:
        painted(view, event)
        watch.painted()
    PictureView.paintEvent = paint  # type: ignore[assignment, method-assign]
    application = Application(folder / "settings.json", WatchedOpener(watch))
    connection = Connection(RobotChoice("127.0.0.1", ports[0], ports[1]), CanChoice(SIMULATED))
    try:
        return _use(application, watch, folder, connection, times)
    finally:
        application.close()
        PictureView.paintEvent = painted  # type: ignore[method-assign]


def _use(application: Application, watch: Watch, folder: pathlib.Path, connection: Connection,
         times: Times) -> WindowFigures:
    application.open()
    store, flow = application.flow.store, application.flow
    store.settings = dataclasses.replace(store.settings, result_folder=folder / "results",
                                         progress_folder=folder / "progress", has_sounds=False)
    flow.connecting.connect_to(connection)
    until(lambda: flow.model.robot is not None)
    watch.newest_id = lambda: 0 if flow.model.robot is None else flow.model.robot.status.id
    window: Any = application.window
    window.resize(SIZE)
    _pass(1.0)
    rest_cores = _cores(times.rest_s)
    stop_s = [_stop(window.header.stop, watch) for _ in range(times.stops)]
    scenario = SCENARIOS["autolock"]
    flow.start(scenario, scenario.parameters_type())
    until(lambda: flow.model.robot is not None and flow.model.robot.status.mode is Mode.FOLLOWING_WAYPOINT
           and abs(flow.model.robot.status.speed_mps) > 0.0)
    before_mib, paints, pictures = memory_mib(), len(watch.paints_s), len(watch.picture_s)
    measuring_cores = _cores(times.measuring_s)
    frames = len(watch.paints_s) - paints
    flow.stop()
    return WindowFigures(stop_s, watch.picture_s[pictures:], frames / times.measuring_s, rest_cores, measuring_cores,
                         memory_mib(), memory_mib() - before_mib)


def _stop(button: Any, watch: Watch) -> float:
    count, begun_s = len(watch.stops_s), time.monotonic()
    tester: Any = QTest
    tester.mousePress(button, Qt.MouseButton.LeftButton)
    left_s = watch.stops_s[count] if len(watch.stops_s) > count else float("inf")
    tester.mouseRelease(button, Qt.MouseButton.LeftButton)
    _pass(STOP_PAUSE_S)
    return left_s - begun_s


def _cores(wall_s: float) -> float:
    """Return the processor time of this process over wall_s, in cores."""
    begun_s, used_s = time.monotonic(), time.process_time()
    _pass(wall_s)
    return (time.process_time() - used_s) / (time.monotonic() - begun_s)


def memory_mib() -> float:
    """Return the resident memory of this process."""
    fields = pathlib.Path("/proc/self/statm").read_text(encoding="ascii").split()
    return int(fields[1]) * _PAGE_BYTES / _MIB


def _pass(wall_s: float) -> None:
    """Process the window's events for wall_s."""
    end_s = time.monotonic() + wall_s
    until(lambda: time.monotonic() >= end_s, None)


def until(condition: Callable[[], bool], limit_s: Optional[float] = READY_LIMIT_S) -> None:
    """Process the window's events until a condition holds. limit_s: wall time; None: unlimited.

    Raises:
        TimeoutError: the limit has passed.
    """
    end_s = None if limit_s is None else time.monotonic() + limit_s
    flags: Any = QEventLoop.ProcessEventsFlag.AllEvents | QEventLoop.ProcessEventsFlag.WaitForMoreEvents
    while not condition():
        if end_s is not None and time.monotonic() > end_s:
            raise TimeoutError("The window did not get that far.")
        QApplication.processEvents(flags)
        # Without an event loop of the application, deferred deletions must be sent explicitly.
        QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
