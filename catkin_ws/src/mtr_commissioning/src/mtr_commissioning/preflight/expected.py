"""Topics that the robot's nodes need, and how often they have to come."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, field
from typing import List, Mapping, NamedTuple, Sequence

from mtr_core import names
from mtr_core.schedule import CONTROLLER_INPUT, FIRMWARE, LIDAR, SENSORS, Slot
from mtr_description.base_controller import CONTROLLER

# Once a second, as a Jackal and the simulated robot say it; nobody decides by it within seconds.
# Owner of a motion lock that drive control has when the manual controller is started with the robot.
CONTROLLER_OWNER = "controller_input"
BATTERY = Slot(1_000_000_000, 0)
# Less often than this share of the expected rate a driver is set up wrongly, or messages get lost.
MIN_RATE_SHARE = 0.8
# Drive control brakes after 0.10 s without odometry.
MAX_GAP_PERIODS, MIN_GAP_LIMIT_S = 3.0, 0.1
# From the stamp to the arrival here. The median has half of it.
MAX_AGE_S = 0.1
# Drive control brakes when the first beam of a LiDAR's newest sweep is older: its lidar_timeout_s.
LIDAR_TIMEOUT_S = 0.14
# Drive control's default of this name.
REACTION_S = 0.08


@dataclass(frozen=True)
class Setup:
    """What the robot was started with; parameters of its nodes say it.

    Attributes:
        rear_lidar: there is one.
        controller: the manual controller's node runs.
        base_guard: the node in front of a base without limits runs.
        base_controller: namespace of the base's parameters.
        is_simulated: time or robot are simulated.
        written_folders: into which its nodes write.
        frames: link of the description -> frame in which the sensor speaks, where that has another name.
        time_increment_s: from beam to beam, as the nodes take it where the scans do not say it; 0: they do not know.
        turn_rate_hz: of the LiDARs by the data sheet of their kind; where none is named, that of the simulated ones.
        lidar_timeout_s: drive control brakes when the first beam of the newest sweep is older.
        reaction_s: that drive control assumes from a decision to braking wheels.
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
        """Namespace of the parameters that stop the robot when drive control is dead."""
        return f"{names.BASE_GUARD}/{CONTROLLER}" if self.base_guard else self.base_controller


class Expected(NamedTuple):
    """One topic.

    Attributes:
        topic: its name.
        type: of its messages.
        period_s: between two messages.
        max_age_s: from the stamp to the arrival; 0 for messages without stamp.
        remedy: what to do when it does not come.
        max_newest_age_s: of the newest message at any time, before the next one comes; 0: nobody minds.
    """

    topic: str
    type: str
    period_s: float
    max_age_s: float
    remedy: str
    max_newest_age_s: float = 0.0

    @property
    def max_gap_s(self) -> float:
        """Longest time between two messages that nobody minds."""
        return max(MIN_GAP_LIMIT_S, MAX_GAP_PERIODS * self.period_s)

    @property
    def min_rate_hz(self) -> float:
        """Least rate."""
        return MIN_RATE_SHARE / self.period_s


def expected_topics(setup: Setup) -> List[Expected]:
    """All topics that have to come, given what the robot was started with."""
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
    """The sweeps of one LiDAR, each stamped with its first beam: as often as its data sheet says, and so that drive
    control is never without one."""
    return Expected(topic, "sensor_msgs/LaserScan", 1.0 / setup.turn_rate_hz, setup.lidar_timeout_s, remedy,
                    setup.lidar_timeout_s)


def seconds(slot: Slot) -> float:
    """Period of a slot in s."""
    return slot.period_ns * 1e-9
