"""All standing checks, and findings as a file."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
from typing import List, Optional

from mtr_description.base_controller import BaseController
from mtr_description.robot_geometry import RobotGeometry
from mtr_motion_check.finding import Finding, exit_code

from .base import base_findings, parameter_findings, start_findings
from .expected import Setup
from .frames import frame_findings
from .mounts import mount_findings
from .records import RobotRecord
from .topics import topic_findings
from .transforms import transform_findings

# Version of the file, increased only if a part is removed.
VERSION = 1


def standing_findings(record: RobotRecord, setup: Setup, geometry: Optional[RobotGeometry], shipped: BaseController
                      ) -> List[Finding]:
    """Run all checks of the received data. Without geometry no frames are checked."""
    frames = [*frame_findings(record, setup, geometry), *mount_findings(record, setup, geometry)] if geometry else []
    return [*start_findings(record), *parameter_findings(record), *topic_findings(record, setup), *frames,
            *transform_findings(record.transforms), *base_findings(record, setup, shipped)]


def write(findings: List[Finding], path: pathlib.Path) -> None:
    """Write the findings as JSON: version, ok, and one object for each; OSError if the file cannot be written."""
    content = {"version": VERSION, "ok": exit_code(findings) == 0, "findings": [each.fields() for each in findings]}
    path.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")
