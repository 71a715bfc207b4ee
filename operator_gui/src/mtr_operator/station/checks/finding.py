"""Possible findings of the checks before the robot moves."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass


class Check(enum.Enum):
    """Checks, in the order of the list."""

    LINK = "link"
    ENCRYPTION = "encryption"
    ROBOT = "robot"
    PREFLIGHT = "preflight"
    EMERGENCY_STOP = "emergency stop"
    POSITION = "position"
    TEST_AREA = "test area"
    SIZE = "size"
    WAY = "way"
    STOP_TRIAL = "stop trial"
    GROUND = "ground"
    CABLES = "cables"
    OPENINGS = "doors and lids"
    FITTINGS = "fittings"
    AREA = "area"
    PEOPLE = "people"
    WEATHER = "weather"
    LIGHT = "light"
    CAR = "Car"
    ATTENDANCE = "attendance"
    LIDARS = "LiDARs"
    BOARD = "board"
    BATTERY = "battery"
    BUS = "CAN bus"
    LOCKS = "locks"
    SIGNALS = "Car's signals"
    CLOCK = "clock map"
    ROBOT_CLOCK = "robot's clock"
    KEY = "key"
    DISK = "disk"
    LIMITS = "limits"


class State(enum.Enum):
    """State of a finding. GOOD: as required. NOTE: information for the Operator that prevents nothing. UNKNOWN: not
    determined. BAD: prevents the start of a test."""

    GOOD = "good"
    NOTE = "note"
    UNKNOWN = "unknown"
    BAD = "bad"


class Finding(enum.Enum):
    """Findings; a view has a sentence for each, and a remedy if something has to be done."""

    UNHEARD = "unheard"
    LINK_ALIVE = "link alive"
    LINK_SILENT = "link silent"
    ENCRYPTED = "encrypted"
    NOT_ENCRYPTED = "not encrypted"
    LOCAL_LINK = "link within this computer"
    ROBOT_READY = "robot ready"
    ROBOT_STARTING = "robot starting"
    ROBOT_FAULT = "robot fault"
    OTHER_OPERATOR = "other operator"
    ROBOT_SAYS = "robot says"
    IN_SERVICE = "in service mode"
    PREFLIGHT_FINE = "preflight fine"
    PREFLIGHT_OLD = "preflight old"
    PREFLIGHT_AT_REST = "preflight at rest"
    PREFLIGHT_BAD = "preflight bad"
    PREFLIGHT_NEVER = "preflight never"
    PREFLIGHT_UNTOLD = "preflight untold"
    STOP_RELEASED = "stop released"
    STOP_ENGAGED = "stop engaged"
    STOP_ABSENT = "stop absent"
    STOP_MISSING = "stop missing"
    STOP_UNTRIED = "stop untried"
    STOP_UNKNOWN = "stop unknown"
    POSITION_KNOWN = "position known"
    POSITION_TO_COME = "position to come"
    POSITION_LOST = "position lost"
    SIZE_KNOWN = "size known"
    SIZE_OF_PLANE = "size of plane"
    SIZE_VAGUE = "size vague"
    SIZE_TOO_VAGUE = "size too vague"
    SIZE_TO_COME = "size to come"
    WAY_FREE = "way free"
    WAY_HINDERED = "way hindered"
    WAY_UNSEEN = "way unseen"
    WAY_TO_COME = "way to come"
    GROUND_UNSEEN = "ground unseen"
    CABLES_UNSEEN = "cables unseen"
    OPENINGS_UNSEEN = "openings unseen"
    OPENINGS_OPEN = "openings open"
    FITTINGS_UNSEEN = "fittings unseen"
    AREA_UNSEEN = "area unseen"
    PEOPLE_UNSEEN = "people unseen"
    WEATHER_UNSEEN = "weather unseen"
    LIGHT_UNSEEN = "light unseen"
    CAR_UNSEEN = "Car unseen"
    ATTENDANCE_UNSEEN = "attendance unseen"
    CONFIRMED = "confirmed"
    LIDARS_FINE = "lidars fine"
    BOARD_FINE = "board fine"
    PART_TROUBLED = "part troubled"
    AREA_KEPT = "area kept"
    AREA_FIXED = "area fixed"
    AREA_MISSING = "area missing"
    AREA_NOT_NEEDED = "area not needed"
    AREA_UNTOLD = "area untold"
    BATTERY_FINE = "battery fine"
    BATTERY_SUFFICES = "battery suffices"
    BATTERY_SHORT = "battery short"
    BATTERY_LOW = "battery low"
    BATTERY_EMPTY = "battery empty"
    BATTERY_UNKNOWN = "battery unknown"
    BUS_FINE = "bus fine"
    BUS_SIMULATED = "bus simulated"
    BUS_FULL = "bus full"
    BUS_SLOW = "bus slow"
    BUS_TROUBLED = "bus troubled"
    NO_ADAPTER = "no adapter"
    LOCKS_HEARD = "locks heard"
    LOCKS_UNKNOWN = "locks unknown"
    SIGNALS_FINE = "signals fine"
    SIGNALS_UNNAMED = "signals unnamed"
    SIGNALS_SILENT = "signals silent"
    SIGNAL_ACTIVE = "signal active"
    CLOCK_MAPPED = "clock mapped"
    CLOCK_NOT_MAPPED = "clock not mapped"
    CLOCK_UNKNOWN = "clock unknown"
    ROBOT_CLOCK_FINE = "robot's clock fine"
    ROBOT_CLOCK_APART = "robot's clock apart"
    ROBOT_CLOCK_SIMULATED = "robot's clock simulated"
    KEY_ANSWERED = "key answered"
    KEY_UNKNOWN = "key unknown"
    DISK_FINE = "disk fine"
    DISK_SHORT = "disk short"
    DISK_FULL = "disk full"
    DISK_UNKNOWN = "disk unknown"
    LIMITS_LOADED = "limits loaded"
    LIMITS_UNFIT = "limits unfit"
    NO_LIMITS = "no limits"


@dataclass(frozen=True)
class Item:
    """One line of the list.

    said: translatable sentence of robot, link or file. numbers: of the view's sentence, in the finding's order, in s,
    m, percent, MB or counts. parts: all sentences of a check that was done elsewhere.
    """

    check: Check
    state: State
    finding: Finding
    said: str = ""
    numbers: tuple[float, ...] = ()
    parts: tuple[tuple[State, str], ...] = ()
