"""Where, when and with what a test is measured, as it stands in its files."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import math
from typing import Mapping, Sequence

from mtr_operator import __version__

from ..clocks.clock_offset import span_text
from ..geometry.area import corners_text
from ..robot_status import AreaState, PreflightReport

STARTED, CONTINUED, ROBOT_SOFTWARE = "started", "continued", "robot software"
# Only in the record of a test in which it happened.
ENDED_BY, RECOVERED = "ended before its end", "recovered"
MEASURED_AGAIN = "measured again"
WIDENED = "wider intervals"
ANNOTATED = "notes and photos added"
REFUSED_STATUSES = "messages of the robot that were not used"
REFUSED_COMMANDS = "messages that the robot refused"
# Only in the record of a test over an encrypted link.
LINK, CONTROLLED_BY = "link", "robot controlled with the key of"
ENCRYPTED = "encrypted"
# Only in the record of a test on a real bus: how the adapter was opened, those of further buses, and which clock timed
# the frames.
CAN_ADAPTER, CAN_STAMPS = "CAN adapter", "CAN frames timed by"
CAN_ADAPTER_OF_BUS = CAN_ADAPTER + " of the bus {}"
# Only in the record of a test on a real robot.
SUPERVISION, CONDITIONS_CONFIRMED = "supervision", "operating conditions confirmed"
SOFTWARE, ROBOT, CAR_PROFILE = "software", "robot", "car profile"
# Only in the record of a test whose profile is a file: its name and SHA-256, and those of its databases.
CAR_PROFILE_FILES = "car profile files"
# Only in the record of a test with a robot that tells the time of day.
CLOCK_OFFSET = "robot's clock ahead of the laptop's by"
# Only in the record of a test whose robot had one since it was started.
PREFLIGHT = "robot's preflight"
# Only in the record of a test whose robot kept inside one.
TEST_AREA = "test area"
# What stands in the record for the robot or the profile where a substitute took its part.
SUBSTITUTE = "substitute"
# The window names the robot's substitute so, and a campaign its own with what it simulates behind a colon.
_SIMULATED = "simulated"
# Only in the record of a test in which something tells the distance of a phone.
PHONE_FEED = "phone's distance from"
REFUSED_REPORTS = "distances of the phone that were not used"
REFUSED_FRAMES = "frames of the Car that were not believed"


def software() -> str:
    """This application and its version."""
    return f"mtr-operator {__version__}"


def session_record(started: datetime.datetime, robot: str, car_profile: str,
                   profile_files: str = "") -> dict[str, str]:
    """Record of a test that begins now; robot: its address, or what stands for it. profile_files: see
    CAR_PROFILE_FILES."""
    return {
        STARTED: written(started),
        SOFTWARE: software(),
        ROBOT: robot,
        CAR_PROFILE: car_profile,
        **({CAR_PROFILE_FILES: profile_files} if profile_files else {}),
        "units": "SI; angles in degrees where the column says so; 1 sigma uncertainties",
        "coordinates": "Car coordinate system: origin in the Car's centre, x to its front, y to its left",
    }


def is_simulated(robot: str) -> bool:
    """True when the robot of a record is none."""
    return robot.partition(":")[0] in (SUBSTITUTE, _SIMULATED)


def controller_record(name: str) -> dict[str, str]:
    """Whose key the robot obeys, as the robot names its owner; nothing on a link that is not encrypted."""
    return {LINK: ENCRYPTED, CONTROLLED_BY: name} if name else {}


def clock_record(ahead_s: float) -> dict[str, str]:
    """By how much the robot's clock is ahead of the laptop's; nothing where it is not known (NaN)."""
    return {} if math.isnan(ahead_s) else {CLOCK_OFFSET: f"{ahead_s:.3f} s"}


def preflight_record(report: PreflightReport | None, steady_s: float) -> dict[str, str]:
    """What the robot's last preflight found, and how long ago by its steady clock; nothing where none was made."""
    if report is None or not report.was_made_before(steady_s):
        return {}
    age_s = max(steady_s - report.made_s, 0.0)
    return {PREFLIGHT: f"{report.checks} checks, {report.bad} bad, {span_text(age_s)} before"}


def area_record(area: AreaState | None) -> dict[str, str]:
    """Corners of the area that the robot enforces; nothing without one."""
    if area is None or not area.corners:
        return {}
    source = "of the robot's launch file" if area.is_fixed else "drawn"
    return {TEST_AREA: f"{corners_text(area.corners)} (x y in m in the robot's start frame, {source})"}


def again_text(session: Mapping[str, str], numbers: Sequence[int]) -> str:
    """What the record says of lines that are measured once more: those of before, and these."""
    before = session.get(MEASURED_AGAIN, "")
    return ", ".join(filter(None, (before, *map(str, numbers))))


def now() -> datetime.datetime:
    """Local time with its distance from UTC."""
    return datetime.datetime.now().astimezone()


def written(moment: datetime.datetime) -> str:
    """A moment as it stands in files."""
    return moment.isoformat(timespec="seconds")


def in_utc(moment: str) -> str:
    """An ISO moment of a file in UTC, by which tests are ordered; empty when it is none.

    One without an offset counts as UTC: computers in different time zones must agree on it.
    """
    try:
        # Python 3.9 does not read the letter.
        found = datetime.datetime.fromisoformat(moment[:-1] + "+00:00" if moment.endswith("Z") else moment)
        return (found if found.tzinfo else found.replace(tzinfo=datetime.timezone.utc)).astimezone(
            datetime.timezone.utc).isoformat()
    # The offset may lead out of the calendar.
    except (ValueError, OverflowError):
        return ""
