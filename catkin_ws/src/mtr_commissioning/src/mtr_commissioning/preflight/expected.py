"""Topics that the robot's nodes need, with their minimum rates."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, field
from typing import List, Mapping, NamedTuple, Sequence

from mtr_core import names
from mtr_core.schedule import CONTROLLER_INPUT, FIRMWARE, LIDAR, SENSORS, Slot
from mtr_description.base_controller import CONTROLLER

# Period of 1 s, as on a Jackal and the simulated robot; no decision depends on it within seconds.
CONTROLLER_OWNER = "controller_input"
BATTERY = Slot(1_000_000_000, 0)
# Below this share of the expected rate a driver is configured wrongly, or messages are lost.
MIN_RATE_SHARE = 0.8
# Drive control brakes after 0.10 s without odometry.
MAX_GAP_PERIODS, MIN_GAP_LIMIT_S = 3.0, 0.1
# Limit from the stamp to the arrival here. The limit of the median is half of it.
MAX_AGE_S = 0.1
# Drive control brakes if the first beam of a LiDAR's newest sweep is older: its lidar_timeout_s.
LIDAR_TIMEOUT_S = 0.14
# Drive control's default of this name.
REACTION_S = 0.08


@dataclass(frozen=True)
class Setup:
    """Configuration of the running robot, from the parameters of its nodes.

    Attributes:
        rear_lidar: there is one.
        controller: the manual controller's node runs.
        base_guard: the node in front of a base without limits runs.
        base_controller: namespace of the base's parameters.
        is_simulated: time or robot are simulated.
        written_folders: folders to which its nodes write.
        frames: link of the description -> frame of the sensor's messages, if its name differs.
        time_increment_s: time between beams that the nodes assume if the scans do not state it; 0: unknown.
        turn_rate_hz: of the LiDARs by the data sheet of their kind; without a kind, of the simulated ones.
        lidar_timeout_s: drive control brakes if the first beam of the newest sweep is older.
        reaction_s: assumption of drive control on the time from a decision to braking wheels.
    """

    rear_lidar: bool = True
    controller: bool = True
    base_guard: bool = False
    base_controller: str = f"/{CONTROLLER}"
    is_simulated: bool = False
    time_increment_s: float = 0.0
    turn_rate_hz: float = 1e9 / LIDAR.period_ns
    lidar_timeout_s: float = LIDAR_TIMEOUT_S
    frames: Mapping[str, str] = field(default_factory=dict)
    written_folders: Sequence[str] = ()
    reaction_s: float = REACTION_S

    @property
    def base_parameters(self) -> str:
        """Namespace of the parameters that stop the robot if drive control is dead."""
        return f"{names.BASE_GUARD}/{CONTROLLER}" if self.base_guard else self.base_controller


class Expected(NamedTuple):
    """Requirements on one topic.

    Attributes:
        topic: its name.
        type: of its messages.
        period_s: between two messages.
        max_age_s: from the stamp to the arrival; 0 for messages without a stamp.
        remedy: for a missing topic.
        max_newest_age_s: of the newest message at any time, before the next one arrives; 0: no limit.
    """

    topic: str
    type: str
    period_s: float
    max_age_s: float
    remedy: str
    max_newest_age_s: float = 0.0

    @property
    def max_gap_s(self) -> float:
        """Longest acceptable time between two messages."""
        return max(MIN_GAP_LIMIT_S, MAX_GAP_PERIODS * self.period_s)

    @property
    def min_rate_hz(self) -> float:
        """Minimum rate."""
        return MIN_RATE_SHARE / self.period_s


def expected_topics(setup: Setup) -> List[Expected]:
    """Return all topics that are required in this configuration."""
    topics = [expected_scan(names.FRONT_SCAN, setup, "start the front LiDAR's driver")]
    if setup.rear_lidar:
        topics.append(expected_scan(names.REAR_SCAN, setup, "start the rear LiDAR's driver, or the robot with "
                                    "rear_lidar:=false"))
    topics += [
        Expected(names.WHEEL_ODOMETRY, "nav_msgs/Odometry", seconds(SENSORS), MAX_AGE_S, "start the base"),
        Expected(names.IMU_DATA, "sensor_msgs/Imu", seconds(SENSORS), MAX_AGE_S, "start the IMU's driver"),
        Expected(names.BATTERY, "sensor_msgs/BatteryState", seconds(BATTERY), seconds(BATTERY), "start the base"),
        Expected(names.FIRMWARE_STATE, "mtr_msgs/FirmwareState", seconds(FIRMWARE), 0.0,
                 "connect the peripherals' board"),
    ]
    if setup.controller:
        topics.append(Expected(names.JOY, "sensor_msgs/Joy", seconds(CONTROLLER_INPUT), MAX_AGE_S,
                               "switch the manual controller on, or start the robot with controller:=false"))
    return topics


def expected_scan(topic: str, setup: Setup, remedy: str) -> Expected:
    """Return the requirements on the sweeps of one LiDAR, each stamped with its first beam: the rate of its data sheet,
    and no gap for drive control."""
    return Expected(topic, "sensor_msgs/LaserScan", 1.0 / setup.turn_rate_hz, setup.lidar_timeout_s, remedy,
                    setup.lidar_timeout_s)


def seconds(slot: Slot) -> float:
    """Return the period of a slot in s."""
    return slot.period_ns * 1e-9
