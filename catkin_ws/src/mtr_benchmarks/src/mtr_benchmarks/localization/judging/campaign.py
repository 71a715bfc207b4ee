"""Compares the errors of the first and the last hour of a drive of eight hours."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import List, Optional

import numpy as np

from ...harness.rows import Requirement, Row
from ..methods.errors import PoseErrors, percentile

HOUR_S = 3600.0
# Share that is compared instead in a drive of less than four hours, as in a quick run.
SHARE = 0.25
FIRST = Requirement("campaign, standing, at its beginning", "m")
LAST = Requirement("campaign, standing, at its end", "m")


@dataclass(frozen=True)
class CampaignFigures:
    """95th percentiles of the key's errors at standstill at the beginning and at the end, and of all."""

    duration_s: float
    part_s: float
    first_standstill_p95_m: Optional[float]
    last_standstill_p95_m: Optional[float]
    last_yaw_p95_deg: Optional[float]
    online_p95_m: Optional[float]
    online_max_m: Optional[float]
    unknown_share: float


def figures(errors: PoseErrors) -> CampaignFigures:
    """Return the figures of the drive with these errors."""
    duration_s = float(errors.stamps_s[-1] - errors.stamps_s[0])
    part_s = min(HOUR_S, SHARE * duration_s)
    first = errors.standing & (errors.stamps_s < errors.stamps_s[0] + part_s)
    last = errors.standing & (errors.stamps_s > errors.stamps_s[-1] - part_s)
    return CampaignFigures(
        duration_s, part_s, percentile(errors.key_m[first]), percentile(errors.key_m[last]),
        percentile(np.abs(errors.yaw_deg[last])), percentile(errors.key_m), percentile(errors.key_m, 100.0),
        float(np.mean(np.isnan(errors.key_m))))


def rows(found: CampaignFigures) -> List[Row]:
    """Return rows for information: the growth of the error has no limit."""
    hours = f"{found.part_s / HOUR_S:.2f} of {found.duration_s / HOUR_S:.2f} h"
    return [Row(FIRST, found.first_standstill_p95_m, remark=hours),
            Row(LAST, found.last_standstill_p95_m, remark=hours)]
