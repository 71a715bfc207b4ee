"""Current notices for the Operator."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Dict, Iterator, List, NamedTuple, Tuple

from mtr_core.problems import NO_PROBLEM, Problem, problem_of
from mtr_core.states import CarState, State

from .. import problems
from ..parameters import Parameters
from ..session import SessionState
from .emergency import EmergencyStop
from .inputs import Inputs

INFO, WARNING, ERROR = 1, 2, 3
# Time for which a single event, such as a rejected message, is shown.
SHOWN_S = 3.0
# An application that waits for the robot sends occasionally; between two of its Commands the notice stays.
FOREIGN_SHOWN_S = 10.0
# Number of remembered applications, one of which is shown; a stranger can invent any number.
MAX_FOREIGN = 16
# Codes of drive control's sentences about sensors and base; other codes are about obstacles, locks and sources.
PARTS_OF_DRIVE = tuple(f"drive_control.{part}" for part in (
    "waiting_for_lidar", "waiting_for_odometry", "lidar_", "odometry_", "imu_", "base_", "wheels_slip",
    "second_publisher", "tilt"))
# Codes of drive control at the border of the test area, and without a pose in it.
BORDER_OF_DRIVE = ("drive_control.area_", "drive_control.outside_area")
# Codes of a robot that waits for a test area, which the Operator has to draw.
AREA_CODES = (problems.NO_AREA.code, problems.AREA_OF_OTHER_ORIGIN.code, problems.FIXED_AREA_OF_OTHER_ORIGIN.code)
# Code of the Car locator; no test begins with such a data sheet.
SHEET_CONTRADICTED = "car_locator.sheet_contradicted"
# Codes of a motion lock with a silent owner; MISSED_OTHERWISE has owners whose silence has its own notice.
SILENT_LOCKS = ("drive_control.lock_silent", "drive_control.waiting_for_lock")
MISSED_OTHERWISE = ("dispatcher", "state_machine")


class Notice(NamedTuple):
    """One sentence. code: stable identifier of its kind; severity: 1 info, 2 warning, 3 error."""

    code: str
    severity: int
    problem: Problem


class RecentNotices:
    """Notices of events, shown for a while."""

    def __init__(self) -> None:
        self._notices: Dict[str, Tuple[float, Notice]] = {}

    def add(self, notice: Notice, now_s: float) -> None:
        """Show the notice from now on; a newer one of the same code replaces it."""
        self._notices[notice.code] = (now_s, notice)

    def at(self, now_s: float) -> List[Notice]:
        """Notices shown at now_s."""
        return [notice for shown_s, notice in self._notices.values() if now_s - shown_s <= SHOWN_S]


class ForeignApplications:
    """Applications that send Commands while another one controls the robot."""

    def __init__(self) -> None:
        self._received_s: Dict[int, float] = {}

    def received(self, controlling_id: int, session_id: int, now_s: float) -> Problem:
        """Note a Command of such an application and return the sentence about it."""
        self._received_s.pop(session_id, None)
        self._received_s[session_id] = now_s
        while len(self._received_s) > MAX_FOREIGN:
            del self._received_s[next(iter(self._received_s))]
        return _foreign_problem(controlling_id, session_id)

    def notices(self, controlling_id: int, now_s: float) -> List[Notice]:
        """Return one notice, which stays the same while such Commands arrive; none if no application is in control."""
        self._received_s = {session_id: received_s for session_id, received_s in self._received_s.items()
                            if now_s - received_s <= FOREIGN_SHOWN_S and session_id != controlling_id}
        if not controlling_id or not self._received_s:
            return []
        return [Notice("controlled_by_other", WARNING, _foreign_problem(controlling_id, min(self._received_s)))]


def _foreign_problem(controlling_id: int, session_id: int) -> Problem:
    return problems.FOREIGN_APPLICATION(controlling=f"{controlling_id:x}", foreign=f"{session_id:x}")


def standing_notices(desired: SessionState, fresh: Inputs, parameters: Parameters) -> Iterator[Notice]:
    """Yield the notices that are shown as long as their cause persists."""
    if desired.service:
        yield Notice("service_mode", ERROR, desired.service)
    if fresh.mode is not None and fresh.mode.hold_id:
        yield Notice("held", ERROR, problem_of(fresh.mode.problems, fresh.mode.message))
    if desired.session_id and not desired.link_alive:
        yield Notice("link_lost", ERROR, desired.stop_reason)
    elif desired.session_id and desired.stop_reason and not desired.command.stop:
        yield Notice("command_refused", ERROR, desired.stop_reason)
    if parameters.is_exposed:
        yield Notice("unencrypted", ERROR, problems.UNENCRYPTED())
    for node, why in fresh.start_failures.items():
        yield Notice("node_cannot_start", ERROR, problems.NODE_CANNOT_START(node=node, why=why))
    if fresh.full_disk is not None:
        yield Notice("disk_full", ERROR, problems.DISK_FULL(folder=fresh.full_disk.folder,
                                                            needed_mb=fresh.full_disk.needed_mb))
    yield from _car_notices(fresh)
    yield from _mode_notices(fresh)
    if fresh.pose is not None and not fresh.pose.valid:
        yield Notice("not_localized", ERROR, problem_of(fresh.pose.problems, fresh.pose.message)
                     or problems.POSITION_UNKNOWN())
    yield from _drive_notices(fresh)
    yield from _peripherals_notices(fresh, parameters.low_battery)
    if parameters.warn_without_emergency_stop and fresh.emergency_stop is EmergencyStop.ABSENT:
        yield Notice("no_emergency_stop", ERROR, problems.NO_EMERGENCY_STOP())


def _car_notices(fresh: Inputs) -> Iterator[Notice]:
    car = fresh.car
    if car is None or car.state != CarState.LOCATED or not car.problems:
        return
    if car.problems[0].code == SHEET_CONTRADICTED:
        yield Notice("sheet_contradicted", ERROR, problem_of(car.problems, car.message))


def _mode_notices(fresh: Inputs) -> Iterator[Notice]:
    if fresh.mode is None:
        yield Notice("state_machine_silent", ERROR, problems.STATE_MACHINE_SILENT())
    elif fresh.mode.mode == State.FAULT:
        yield Notice("fault", ERROR, problem_of(fresh.mode.problems, fresh.mode.message))
    elif fresh.mode.message and not fresh.mode.hold_id:
        problem = problem_of(fresh.mode.problems, fresh.mode.message)
        yield (Notice("test_area", ERROR, problem) if problem.code in AREA_CODES else Notice("mode", INFO, problem))


def _drive_notices(fresh: Inputs) -> Iterator[Notice]:
    """Yield reasons for stopped wheels that no other notice covers: sensors, the base itself, silent lock owners."""
    problem = problem_of(fresh.drive.problems, fresh.drive.message) if fresh.drive is not None else NO_PROBLEM
    is_missed = problem.code in SILENT_LOCKS and dict(problem.arguments).get("owner") not in MISSED_OTHERWISE
    if problem.code.startswith(PARTS_OF_DRIVE) or is_missed:
        yield Notice("drive_control", ERROR, problem)
    elif problem.code.startswith(BORDER_OF_DRIVE):
        yield Notice("test_area_border", WARNING, problem)


def _peripherals_notices(fresh: Inputs, low_battery: float) -> Iterator[Notice]:
    state = fresh.peripherals
    if state is None:
        yield Notice("peripherals_silent", ERROR, problems.PERIPHERALS_SILENT())
        return
    if state.message:
        yield Notice("peripherals", WARNING if state.alive else ERROR,
                     problem_of(state.problems, state.message))
    if not math.isnan(state.battery) and state.battery < low_battery:
        yield Notice("low_battery", WARNING, problems.LOW_BATTERY(percent=100.0 * state.battery))
