"""Faults of base and sensors that drive control reports during the drive and that stop the robot."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Mapping

from mtr_motion_check.finding import Finding, bad

CHECK, SUBJECT = "motion.stopped", "drive control"
# Codes of its sentences about motion that contradicts the commands.
CONTRADICTIONS = ("drive_control.base_stands", "drive_control.base_disobeys", "drive_control.odometry_frozen",
                  "drive_control.imu_frozen", "drive_control.wheels_slip")


def obedience_findings(heard: Mapping[str, str]) -> List[Finding]:
    """Return a finding from its sentences by code; empty without a contradiction."""
    return [bad(CHECK, SUBJECT, f"It stopped the robot, so that nothing more was compared. {heard[code]} Odometry of "
                "the wrong sign says the opposite of what was told; else look at the base's own emergency stop and at "
                "the sensor that is named.") for code in CONTRADICTIONS if code in heard]
