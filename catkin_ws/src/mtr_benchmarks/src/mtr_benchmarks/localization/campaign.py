"""Whether the error grows over a working day: the first and the last hour of a drive of eight hours."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, Optional

import numpy as np

from .errors import Errors, percentile

HOUR_S = 3600.0
# Of a drive that is shorter than two hours, as in a quick run, the first and the last quarter.
SHARE = 0.25


def figures(errors: Errors) -> Dict[str, Any]:
    """95 % of the key's errors at standstill at the beginning and at the end, and over all."""
    duration_s = float(errors.stamps_s[-1] - errors.stamps_s[0])
    part_s = min(HOUR_S, SHARE * duration_s)
    first = errors.standing & (errors.stamps_s < errors.stamps_s[0] + part_s)
    last = errors.standing & (errors.stamps_s > errors.stamps_s[-1] - part_s)
    return {"duration_s": duration_s, "part_s": part_s,
            "first_standstill_p95_m": percentile(errors.key_m[first]),
            "last_standstill_p95_m": percentile(errors.key_m[last]),
            "last_yaw_p95_deg": percentile(np.abs(errors.yaw_deg[last])),
            "online_p95_m": percentile(errors.key_m), "online_max_m": percentile(errors.key_m, 100.0),
            "unknown_share": float(np.mean(np.isnan(errors.key_m)))}


def sentence(found: Dict[str, Any]) -> str:
    """The figures for a person."""
    first, last = (_cm(found[f"{part}_standstill_p95_m"]) for part in ("first", "last"))
    return f"Campaign of {found['duration_s'] / HOUR_S:.1f} h, standing: {first} at the beginning, {last} at the end."


def _cm(value_m: Optional[float]) -> str:
    return "unknown" if value_m is None else f"{100.0 * value_m:.2f} cm"
