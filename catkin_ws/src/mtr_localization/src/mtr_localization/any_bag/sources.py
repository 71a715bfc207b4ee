"""Selection of the topics of a bag: given by the user, otherwise by type."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Dict, List, Optional, Tuple

from mtr_core import names

from .errors import BagUnusable

SCAN, ODOMETRY, IMU = "sensor_msgs/LaserScan", "nav_msgs/Odometry", "sensor_msgs/Imu"
TF = "tf"
NONE = "none"


@dataclass(frozen=True)
class Asked:
    """Topics, frames and times given by the user; None selects them from the bag.

    Attributes:
        front_scan, rear_scan, odometry, imu: topics; odometry may be TF, rear_scan and imu NONE.
        base_frame: frame of the robot, with x forward.
        urdf: file with the mounts, for bags without transforms.
        scan_delay_s: delay of the scan stamps; None compares the recording times.
        time_increment_s: time between beams if the scans do not state it.
    """

    front_scan: Optional[str] = None
    rear_scan: Optional[str] = None
    odometry: Optional[str] = None
    imu: Optional[str] = None
    base_frame: Optional[str] = None
    urdf: Optional[str] = None
    scan_delay_s: Optional[float] = None
    time_increment_s: Optional[float] = None


def is_own(topics: Dict[str, str], asked: Asked) -> bool:
    """Return True for a recording of this robot, which is replayed without conversion."""
    return asked == Asked() and {names.FRONT_SCAN, names.IMU_DATA, names.WHEEL_ODOMETRY} <= set(topics)


def scans_of(topics: Dict[str, str], asked: Asked) -> List[str]:
    """Return one or two scan topics: front and rear if they are given, otherwise in any order."""
    found = sorted(topic for topic, kind in topics.items() if kind == SCAN)
    if asked.front_scan is not None:
        wanted = [asked.front_scan]
        if asked.rear_scan is not None and asked.rear_scan != NONE:
            wanted.append(asked.rear_scan)
        for topic in wanted:
            _check(topics, topic, SCAN)
        return wanted
    if not found:
        raise BagUnusable(f"The bag has no scans: no topic of type {SCAN}. It has {_listed(topics)}.")
    if len(found) > 2 or (asked.rear_scan == NONE and len(found) > 1):
        raise BagUnusable(f"The bag has scans on {', '.join(found)}; name those of a level LiDAR by --front-scan and "
                          "--rear-scan.")
    return found


def odometry_of(topics: Dict[str, str], asked: Asked) -> str:
    """Return the topic of the odometry, or TF."""
    if asked.odometry is not None and asked.odometry != TF:
        _check(topics, asked.odometry, ODOMETRY)
        return asked.odometry
    found = sorted(topic for topic, kind in topics.items() if kind == ODOMETRY)
    if asked.odometry == TF or not found:
        return TF
    if len(found) > 1:
        raise BagUnusable(f"The bag has odometry on {', '.join(found)}; name that of the wheels by --odometry.")
    return found[0]


def imu_of(topics: Dict[str, str], asked: Asked) -> Optional[str]:
    """Return the topic of a gyro; None selects the turn of the wheels instead."""
    if asked.imu == NONE:
        return None
    if asked.imu is not None:
        _check(topics, asked.imu, IMU)
        return asked.imu
    found = sorted(topic for topic, kind in topics.items() if kind == IMU)
    if len(found) > 1:
        raise BagUnusable(f"The bag has IMUs on {', '.join(found)}; name one by --imu, or none.")
    return found[0] if found else None


def front_and_rear(places: List[Tuple[str, float]]) -> Tuple[str, Optional[str]]:
    """Return the front topic first, from one or two topics with the x position of their LiDAR on the base in m."""
    if len(places) == 1:
        return places[0][0], None
    (rear, rear_m), (front, front_m) = sorted(places, key=lambda place: place[1])
    if front_m == rear_m:
        raise BagUnusable(f"The LiDARs of {rear} and {front} are equally far ahead; name them by --front-scan and "
                          "--rear-scan.")
    return front, rear


def _check(topics: Dict[str, str], topic: str, kind: str) -> None:
    if topic not in topics:
        raise BagUnusable(f"The bag has no topic {topic}. It has {_listed(topics)}.")
    if topics[topic] != kind:
        raise BagUnusable(f"The topic {topic} is of type {topics[topic]}; {kind} is needed.")


def _listed(topics: Dict[str, str]) -> str:
    return ", ".join(sorted(topics)) or "nothing"
