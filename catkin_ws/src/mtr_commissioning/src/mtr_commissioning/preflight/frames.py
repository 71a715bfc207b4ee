"""Checks the frames of scans and IMU against the robot's description."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Mapping, Optional

from mtr_core import names
from mtr_core.errors import ConfigurationError
from mtr_description.mounts import LidarMounts
from mtr_description.robot_geometry import RobotGeometry
from mtr_motion_check.finding import Finding, bad, good

from .expected import Setup
from .records import RobotRecord

FRAME, DESCRIPTION = "frame.of_topic", "frame.description"
SCAN_FRAMES = {names.FRONT_SCAN: names.FRONT_LIDAR, names.REAR_SCAN: names.REAR_LIDAR}


def frame_findings(record: RobotRecord, setup: Setup, geometry: RobotGeometry) -> List[Finding]:
    """Check mounts in the description, and the frame of each received topic."""
    frames = {topic: setup.frames.get(link, link) for topic, link in {**SCAN_FRAMES, names.IMU_DATA: names.IMU}.items()}
    if not setup.rear_lidar:
        del frames[names.REAR_SCAN]
    found = [description_finding(geometry, setup)]
    for topic, frame in frames.items():
        if record.topic(topic).frames:
            others = {each: of for each, of in frames.items() if each in SCAN_FRAMES and each != topic}
            found.append(frame_finding(topic, frame, list(record.topic(topic).frames), geometry, others))
    return found


def description_finding(geometry: RobotGeometry, setup: Setup) -> Finding:
    """Check that the description has all parts that the nodes need."""
    try:
        geometry.lidars(setup.rear_lidar)
        geometry.mount(names.IMU)
        geometry.footprint()
        geometry.key()
    except ConfigurationError as error:
        return bad(DESCRIPTION, names.ROBOT_DESCRIPTION, f"{error} Correct the file that robot_file:= names.")
    return good(DESCRIPTION, names.ROBOT_DESCRIPTION, "It has LiDARs, IMU, footprint and key as the nodes need them.")


def frame_finding(topic: str, frame: str, found: List[str], geometry: RobotGeometry, others: Mapping[str, str]
                  ) -> Finding:
    """Check the frame of a topic's messages. others: of the other LiDARs' topics."""
    if found == [frame]:
        return good(FRAME, topic, f"It comes in the frame {frame}.")
    wrong = next(name for name in found if name != frame)
    other = next((each for each, of in others.items() if of == wrong), None)
    if len(found) > 1:
        what = f"It comes in {len(found)} frames ({', '.join(sorted(found))})"
    else:
        what = f"It comes in the frame {wrong or '(empty)'}"
    if other and topic in SCAN_FRAMES:
        return bad(FRAME, topic, f"{what}, allowed is {frame}: the LiDAR of {other} is on this topic; exchange the "
                   "topics of the LiDARs' drivers.")
    return bad(FRAME, topic, f"{what}, allowed is {frame}{unknown(wrong, geometry)}: set frame_id in its driver, or "
               "tell robot.launch its name (front_frame, rear_frame, imu_frame).")


def unknown(frame: str, geometry: RobotGeometry) -> str:
    """Return a sentence that the robot's description lacks this frame."""
    try:
        geometry.tree.chain(frame)
    except ConfigurationError:
        return ", and robot_description has no such link"
    return ""


def lidar_mounts(geometry: RobotGeometry, setup: Setup) -> Optional[LidarMounts]:
    """Return the mounts of the description; None if they are unusable, which description_finding reports."""
    try:
        return geometry.lidars(setup.rear_lidar)
    except ConfigurationError:
        return None
