"""Splits the sweeps of a recording alternately into two halves: one gives a map, the other is localized on it."""
# SPDX-License-Identifier: Apache-2.0
import collections
import json
import pathlib
from typing import Any, Counter, Dict, List, NamedTuple, Tuple

import numpy as np
import rosbag

from mtr_core import names
from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2
from mtr_localization import replay
from mtr_localization.any_bag.conversions import Found, convert
from mtr_localization.any_bag.frames import yaw_of
from mtr_localization.any_bag.sources import Asked

from ..localization.drives.pose_track import PoseTrack, pose_track, read_columns

SCANS = (names.FRONT_SCAN, names.REAR_SCAN)
TRUTH_TYPE = "geometry_msgs/PoseStamped"


class Halves(NamedTuple):
    """Inputs of localization, as a whole and as both halves, and the interpretation of the bag."""

    whole: pathlib.Path
    even: pathlib.Path
    odd: pathlib.Path
    found: Found

    @property
    def odometry(self) -> PoseTrack:
        """Odometry of the wheels."""
        samples = self.found.samples
        return pose_track(np.array([sample.time_s for sample in samples]),
                          np.array([(sample.pose.x, sample.pose.y, sample.pose.heading) for sample in samples]))

    @property
    def mounts(self) -> Dict[str, Pose2]:
        """base_from_lidar of each scan topic of this robot."""
        return {topic: Pose2(float(place[0, 3]), float(place[1, 3]), yaw_of(place))
                for topic, (_, place) in zip(SCANS, self.found.mounts.values())}


class Localized(NamedTuple):
    """Result of a replay: poses, share of valid ones, CPU time per scan in ms, and its messages."""

    track: PoseTrack
    valid_share: float
    cpu_ms_per_scan: float
    messages: List[str]


def halves_of(bag: pathlib.Path, folder: pathlib.Path, asked: Asked) -> Halves:
    """Write the halves.

    Raises:
        BagUnusable: the bag cannot be used; the text has the reason.
    """
    whole, even, odd = (folder / f"{name}.bag" for name in ("whole", "even", "odd"))
    found = convert(bag, whole, asked, True, lambda _: None)
    seen: Counter[str] = collections.Counter()
    with rosbag.Bag(str(whole)) as read, rosbag.Bag(str(even), "w") as first, rosbag.Bag(str(odd), "w") as second:
        for topic, message, stamp in read.read_messages():
            for number, half in enumerate((first, second)):
                if topic not in SCANS or seen[topic] % 2 == number:
                    half.write(topic, message, stamp)
            seen[topic] += 1
    return Halves(whole, even, odd, found)


def localized(bag: pathlib.Path, out: pathlib.Path, found: Found, *options: str) -> Localized:
    """Replay a half.

    Raises:
        RuntimeError: the replay failed.
    """
    given = [part for name, value in found.parameters.items() for part in ("--parameter", f"{name}={value}")]
    out.mkdir(parents=True, exist_ok=True)
    if replay.main([str(bag), "--out", str(out), "--in-motion", "--no-car", *given, *options]):
        raise RuntimeError(f"The replay of {bag.name} failed.")
    columns = read_columns(out / "trajectory.csv")
    poses = np.stack([columns["x_m"], columns["y_m"], columns["heading_rad"]], axis=1)
    valid = columns["valid"] > 0.5
    summary: Dict[str, Any] = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    return Localized(pose_track(columns["stamp_s"][valid], poses[valid]), float(valid.mean()),
                     float(summary["cpu_ms_per_scan"]), [str(each["message"]) for each in summary["messages"]])


def truth_in(bag: pathlib.Path, topic: str) -> Tuple[FloatArray, FloatArray]:
    """Return stamps (n) in s and positions (n, 2) in m of the independent truth; empty if the bag has no such topic."""
    rows = []
    with rosbag.Bag(str(bag)) as read:
        about = read.get_type_and_topic_info().topics.get(topic)
        if about is not None and about.msg_type == TRUTH_TYPE:
            rows = [(message.header.stamp.to_sec(), message.pose.position.x, message.pose.position.y)
                    for _, message, _ in read.read_messages(topics=[topic])]
    table = np.array(rows, dtype=float).reshape(-1, 3)
    return table[:, 0], table[:, 1:]
