"""Rows of drives with other kinds of LiDARs: accuracy of the pose with each."""
# SPDX-License-Identifier: Apache-2.0
from typing import List

from mtr_core.schedule import LIDAR

from ...harness.rows import Requirement, Row
from ..drives.selection import LIDAR_KINDS, LIDAR_SCENES, LidarKind
from .figures import joined, ratio
from .position_rows import Failures, Outcomes, failed, judged, standing


def rows(outcomes: Outcomes, failures: Failures) -> List[Row]:
    """Return rows for information: a LiDAR that sees less is less accurate, and no limit is defined."""
    return [_row(outcomes, failures, scene, variant, kind) for variant, kind in LIDAR_KINDS.items()
            for scene in LIDAR_SCENES]


def _row(outcomes: Outcomes, failures: Failures, scene: str, variant: str, kind: LidarKind) -> Row:
    errors = joined([each.errors for each in outcomes[scene].get(variant, {}).values()])
    named = Requirement(f"{scene}, standing, {words(kind)}", "m")
    return judged(named, standing(outcomes, scene, variant), failed(failures, scene, variant),
                  {"nees_ratio": ratio(errors.nees)})


def words(kind: LidarKind) -> str:
    """Return a description of the LiDARs for a person."""
    return (f"{'two LiDARs' if kind.rear else 'one LiDAR'} of {kind.beams} beams over {kind.field_deg:.0f} deg at "
            f"{1e9 / LIDAR.period_ns / kind.sweeps_apart:.3g} Hz")
