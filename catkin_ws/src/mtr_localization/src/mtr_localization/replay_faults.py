"""Sentences about the causes of invalid poses in a replay, and how to fix the replay."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Dict, List, NamedTuple, Optional, Sequence

STAND_STILL = "localization.stand_still"
FEW_SURFACES = "surfel_map.few_surfaces"
IMU_SILENT, IMU_NOT_A_NUMBER = "localization.imu_silent", "localization.imu_not_a_number"
WHEELS_SILENT, WHEELS_NOT_FINITE = "localization.wheels_silent", "localization.wheels_not_finite"
# A shorter silence costs few poses and is not reported.
MAX_SILENT_SHARE = 0.05
# A few scans are always late: those in progress while the pose is transferred to a new map.
MAX_LATE_SHARE = 0.05
# Default of the parameter gap_limit_s, see src/parameters.hpp.
GAP_LIMIT_S = 0.2
# Intervals vary around their mean; above this share of the limit, many are too long.
NEAR_LIMIT = 0.95


class Topics(NamedTuple):
    """Topics of the inputs; keys of scans are "front" and "rear".

    Without an IMU, the turn of the wheels replaces it.
    """

    scans: Dict[str, str]
    odometry: str
    imu: Optional[str] = None


def faults(summary: Dict[str, Any], topics: Topics, gap_limit_s: float = GAP_LIMIT_S,
           known: Sequence[str] = ()) -> List[str]:
    """Return sentences, the most important first; empty if the replay has no faults.

    Args:
        summary: content of summary.json.
        gap_limit_s: longest accepted interval of odometry and IMU in the replay.
        known: sentences about inputs from before the replay.
    """
    found = causes(summary, topics, gap_limit_s, known)
    # Without odometry and IMU, scans are late and the gyro bias is not measured, so such advice is dropped.
    advice = [] if found else [*_late_scans(summary), *_no_standstill(summary)]
    return [*found, *_refused_scans(summary, topics), *advice, *_unused_scans(summary, topics)]


def causes(summary: Dict[str, Any], topics: Topics, gap_limit_s: float = GAP_LIMIT_S,
           known: Sequence[str] = ()) -> List[str]:
    """Return sentences about slow or silent inputs; arguments as in faults(). Other advice would be misleading."""
    found = [*known, *_slow_odometry(summary, topics, gap_limit_s), *_slow_imu(summary, topics, gap_limit_s)]
    return found or _silent_sensors(summary, topics)


def is_useless(summary: Dict[str, Any]) -> bool:
    """Return True if no pose is reliable."""
    return not summary["scans_used"] or not summary["poses_valid"] or shows_nothing(summary)


def shows_nothing(summary: Dict[str, Any]) -> bool:
    """Return True if the key frames of a new map contain no surface, so that poses are dead reckoning."""
    return summary.get("surfels") == 0 and any(message["code"] == FEW_SURFACES for message in summary["messages"])


def _refused_scans(summary: Dict[str, Any], topics: Topics) -> List[str]:
    found = []
    for refusal in sorted(summary["refusals"], key=lambda each: -each["count"]):
        topic = topics.scans.get(refusal["lidar"], "unknown topic")
        found.append(f"{refusal['count']} scans of the {refusal['lidar']} LiDAR ({topic}) were refused. "
                     f"{refusal['message']}")
    return found


def _late_scans(summary: Dict[str, Any]) -> List[str]:
    late = summary["scans_refused"] - sum(refusal["count"] for refusal in summary["refusals"])
    if late <= MAX_LATE_SHARE * summary["scans"]:
        return []
    return [f"{late} scans came too late to correct a pose; their stamps may be wrong: give --scan-delay."]


def _unused_scans(summary: Dict[str, Any], topics: Topics) -> List[str]:
    listed = ", ".join(topics.scans.values())
    if not summary["scans"]:
        return [f"The bag has no scans on {listed}, so no pose is valid."]
    if not summary["scans_used"]:
        return [f"None of the {summary['scans']} scans was used, so no pose is valid."]
    if shows_nothing(summary):
        return [f"The scans on {listed} show no surface, so no pose is valid: check their ranges, range_min and "
                "range_max."]
    return []


def _slow_odometry(summary: Dict[str, Any], topics: Topics, gap_limit_s: float) -> List[str]:
    interval_s = _interval_s(summary, "wheel_samples")
    if not _is_slow(interval_s, summary, gap_limit_s):
        return []
    return [f"Odometry on {topics.odometry} comes every {interval_s:.2f} s, and {gap_limit_s:g} s are accepted; give "
            f"--parameter gap_limit_s={min(1.0, 2.0 * interval_s):.1f}."]


def _slow_imu(summary: Dict[str, Any], topics: Topics, gap_limit_s: float) -> List[str]:
    interval_s = _interval_s(summary, "imu_samples")
    if topics.imu is None or not _is_slow(interval_s, summary, gap_limit_s):
        return []
    return [f"The IMU on {topics.imu} comes every {interval_s:.2f} s, and must come more often than every "
            f"{gap_limit_s:g} s: raise its rate, or replay with --imu none."]


def _interval_s(summary: Dict[str, Any], samples: str) -> float:
    """Return the mean interval; 0 for too few samples."""
    count = summary.get(samples, 0)
    return float(summary["duration_s"] / (count - 1)) if count >= 2 else 0.0


def _is_slow(interval_s: float, summary: Dict[str, Any], gap_limit_s: float) -> bool:
    return interval_s > (gap_limit_s if summary["poses_valid"] else NEAR_LIMIT * gap_limit_s)


def _silent_sensors(summary: Dict[str, Any], topics: Topics) -> List[str]:
    found = []
    for message in summary["messages"]:
        topic = {IMU_SILENT: topics.imu, IMU_NOT_A_NUMBER: topics.imu, WHEELS_SILENT: topics.odometry,
                 WHEELS_NOT_FINITE: topics.odometry}.get(message["code"])
        if topic and message["count"] > MAX_SILENT_SHARE * summary["poses"]:
            remedy = ", or replay with --imu none" if topic == topics.imu else ""
            found.append(f"{message['message']} It concerns {message['count']} of {summary['poses']} poses: check "
                         f"stamps and values of {topic}{remedy}.")
    return found


def _no_standstill(summary: Dict[str, Any]) -> List[str]:
    standing = [message for message in summary["messages"] if message["code"] == STAND_STILL]
    if summary["poses_valid"] or not standing or 2 * standing[0]["count"] < summary["poses"]:
        return []
    return ["The gyro's bias was not measured: the robot does not stand still for 1 s at the start. Replay the bag "
            "with --in-motion."]
