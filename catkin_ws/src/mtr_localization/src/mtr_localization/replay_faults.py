"""Sentences on what made a replay's poses invalid, and how to replay the bag with success."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, List, NamedTuple

STAND_STILL = "localization.stand_still"
FEW_SURFACES = "surfel_map.few_surfaces"
# A few scans are always late: those under way while the pose is set to that of a new map.
MAX_LATE_SHARE = 0.05
# Default of the parameter gap_limit_s, see src/parameters.hpp.
GAP_LIMIT_S = 0.2


class Topics(NamedTuple):
    """Topics of the bag that the inputs come from; a LiDAR's key is "front" or "rear"."""

    scans: Dict[str, str]
    odometry: str


def faults(summary: Dict[str, Any], topics: Topics, gap_limit_s: float = GAP_LIMIT_S) -> List[str]:
    """Sentences, the most important first; empty when the replay needs no remark.

    Args:
        summary: content of summary.json.
        gap_limit_s: longest interval of odometry that the replay accepted.
    """
    return [*_refused_scans(summary, topics), *_slow_odometry(summary, topics, gap_limit_s), *_no_standstill(summary)]


def is_useless(summary: Dict[str, Any]) -> bool:
    """True when no pose may be relied on."""
    return not summary["scans_used"] or not summary["poses_valid"] or shows_nothing(summary)


def shows_nothing(summary: Dict[str, Any]) -> bool:
    """True when the key-frames of a new map contain no surface: the poses follow the wheels alone."""
    return summary.get("surfels") == 0 and any(message["code"] == FEW_SURFACES for message in summary["messages"])


def _refused_scans(summary: Dict[str, Any], topics: Topics) -> List[str]:
    found = []
    for refusal in sorted(summary["refusals"], key=lambda each: -each["count"]):
        topic = topics.scans.get(refusal["lidar"], "unknown topic")
        found.append(f"{refusal['count']} scans of the {refusal['lidar']} LiDAR ({topic}) were refused. "
                     f"{refusal['message']}")
    late = summary["scans_refused"] - sum(refusal["count"] for refusal in summary["refusals"])
    if late > MAX_LATE_SHARE * summary["scans"]:
        found.append(f"{late} scans came too late to correct a pose; their stamps may be wrong: give --scan-delay.")
    if not summary["scans_used"]:
        total = summary["scans"]
        found.append(f"None of the {total} scans was used, so no pose is valid." if total else
                     f"The bag has no scans on {', '.join(topics.scans.values())}, so no pose is valid.")
    elif shows_nothing(summary):
        found.append(f"The scans on {', '.join(topics.scans.values())} show no surface, so no pose is valid: check "
                     "their ranges, range_min and range_max.")
    return found


def _slow_odometry(summary: Dict[str, Any], topics: Topics, gap_limit_s: float) -> List[str]:
    if summary["wheel_samples"] < 2:
        return []
    interval_s = summary["duration_s"] / (summary["wheel_samples"] - 1)
    if interval_s <= gap_limit_s:
        return []
    return [f"Odometry on {topics.odometry} comes every {interval_s:.2f} s, and {gap_limit_s:g} s are accepted; give "
            f"--parameter gap_limit_s={min(1.0, 2.0 * interval_s):.1f}."]


def _no_standstill(summary: Dict[str, Any]) -> List[str]:
    standing = [message for message in summary["messages"] if message["code"] == STAND_STILL]
    if summary["poses_valid"] or not standing or 2 * standing[0]["count"] < summary["poses"]:
        return []
    return ["The gyro's bias was not measured: the robot does not stand still for 1 s at the start. Replay the bag "
            "with --in-motion."]
