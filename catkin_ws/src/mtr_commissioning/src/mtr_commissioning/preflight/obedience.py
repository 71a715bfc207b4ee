"""What drive control finds wrong with base and sensors while the robot is driven: it stops, and no way is made."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Mapping

from mtr_motion_check.finding import Finding, bad

CHECK, SUBJECT = "motion.stopped", "drive control"
# Codes of its sentences about motion that is not what was sent.
CONTRADICTIONS = ("drive_control.base_stands", "drive_control.base_disobeys", "drive_control.odometry_frozen",
                  "drive_control.imu_frozen", "drive_control.wheels_slip")


def obedience_findings(heard: Mapping[str, str]) -> List[Finding]:
    """Of its sentences by their codes; nothing when none is about a contradiction."""
    return [bad(CHECK, SUBJECT, f"It stopped the robot, so that nothing more was compared. {heard[code]} Odometry of "
                "the wrong sign says the opposite of what was told; else look at the base's own emergency stop and at "
                "the sensor that is named.") for code in CONTRADICTIONS if code in heard]
