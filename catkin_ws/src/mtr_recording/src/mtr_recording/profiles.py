"""Profiles of recorded topics, their disk space, and the rosbag command that records them."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import Callable, Dict, List, Tuple

from mtr_core import names
from mtr_core.errors import RobotError
from mtr_dispatcher.disks.room import MEGA, RESERVE_BYTES

# Decisions and the poses that they rely on: some minutes fit into an e-mail.
SMALL: Tuple[str, ...] = (
    names.DESIRED_STATE, names.ROBOT_MODE, names.CAR_ESTIMATE, names.CAR_CHECK, names.MAPPING_ORDER,
    names.LOCALIZED_POSE, names.MOTION_STATUS, names.MOTION_PATH, names.MOTION_LOCK, names.DRIVE_STATUS,
    names.PERIPHERALS_STATE, names.PLANNER_VELOCITY, names.MANUAL_VELOCITY, names.WHEEL_COMMAND, names.BATTERY,
    names.JOY, names.MAP_GRID, "/rosout", "/diagnostics", "/tf", "/tf_static")
# Includes all inputs of the decisions, for a replay, and the topics that rviz shows.
FULL: Tuple[str, ...] = (
    *SMALL, names.FRONT_SCAN, names.REAR_SCAN, names.IMU_DATA, names.WHEEL_ODOMETRY, names.NAVSAT_FIX,
    names.SURFACE_MAP, names.CAR_MARKERS, names.LOCALIZATION_MARKERS, names.MOTION_MARKERS, names.DRIVE_MARKERS,
    names.FIRMWARE_STATE, names.FIRMWARE_COMMAND, names.FIRMWARE_PRESS, names.FIRMWARE_HEALTH, names.FIRMWARE_INPUTS,
    names.FIRMWARE_SIGNALS, names.JOINT_STATES, names.MANUAL_LIFT)
PROFILES: Dict[str, Tuple[str, ...]] = {"small": SMALL, "full": FULL}
# Orders that are recorded under RECORDED: nodes and base act on some of these at any age, and a bag that is played on a
# robot must not move it.
ORDERS: Tuple[str, ...] = (names.JOY, names.WHEEL_COMMAND, names.PLANNER_VELOCITY, names.MANUAL_VELOCITY,
                           names.MANUAL_LIFT, names.MOTION_LOCK, names.FIRMWARE_COMMAND, names.FIRMWARE_PRESS,
                           names.FIRMWARE_SIGNALS)
RECORDED = "/recorded"
# Topics that replay.launch plays: sensors, and inputs of localization, Car locator and state machine from other nodes.
# Outputs of these nodes are excluded: the recorded mode ends the survey when the recorded Car was found, but the replay
# may not have found it by then.
REPLAYED: Tuple[str, ...] = (names.FRONT_SCAN, names.REAR_SCAN, names.IMU_DATA, names.WHEEL_ODOMETRY, names.NAVSAT_FIX,
                             names.DESIRED_STATE, names.MOTION_STATUS, names.DRIVE_STATUS, names.PERIPHERALS_STATE)

# Number of equal files of a recording; when the last is full the oldest is removed.
PARTS = 8
MIN_LIMIT_MB, MAX_LIMIT_MB = 80.0, 1e6
DEFAULT_LIMIT_MB: Dict[str, float] = {"small": 400.0, "full": 4000.0}


class CannotRecord(RobotError):
    """Recording is impossible; the sentence states cause and remedy."""


class CannotReplay(RobotError):
    """Replay is impossible; the sentence states cause and remedy."""


def check_room(folder: pathlib.Path, limit_mb: float, free_bytes: float) -> None:
    """Raise CannotRecord unless the whole recording fits, and leaves the space that a day of work needs."""
    free_mb, needed_mb = free_bytes / MEGA, limit_mb + RESERVE_BYTES / MEGA
    if free_mb < needed_mb:
        raise CannotRecord(f"{folder} has {free_mb:.0f} MB free; a recording of {limit_mb:.0f} MB needs "
                           f"{needed_mb:.0f} MB. Make room, or record less (--limit).")


def recorded_name(topic: str) -> str:
    """Return the topic under which the messages of an order are recorded. topic: its name on this robot."""
    return f"{RECORDED}{topic}"


def command_of(profile: str, prefix: pathlib.Path, limit_mb: float, resolve: Callable[[str], str]) -> List[str]:
    """Return rosbag's command: it keeps the newest limit_mb, in files PREFIX_0.bag, PREFIX_1.bag, ...

    Args:
        resolve: returns the name of a topic on this robot, which may differ from the simulation.
    """
    part_mb = max(1, round(limit_mb / PARTS))
    topics = [recorded_name(resolve(topic)) if topic in ORDERS else resolve(topic) for topic in PROFILES[profile]]
    # The node is used instead of the command rosbag, which passes Ctrl-C on and then ends with a traceback. Without
    # --tcpnodelay a message waits up to 40 ms for the next one.
    return ["rosrun", "rosbag", "record", "--lz4", "--tcpnodelay", "--repeat-latched", "--split", f"--size={part_mb}",
            f"--max-splits={PARTS}", f"--output-name={prefix}", *topics]
