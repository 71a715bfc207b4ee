"""Course of a test as MCAP, which Foxglove opens: poses of robot and key, returns of the LiDARs, and events."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import base64
import io
import json
import math
import pathlib
import struct
from typing import Any, Iterable, Iterator, NamedTuple

from mcap.writer import CompressionType, Writer

from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.storage.recorded.course_file import Moment, read_course
from mtr_operator.storage.recorded.scan_file import Scan

_ENCODING = "json"
_FRAME, _ROBOT_FRAME = "car", "base_link"
_NS_PER_S = 1_000_000_000
_ROBOT, _KEY, _EVENTS, _SCANS = "/robot/pose", "/key/pose", "/test/events", "/lidar/points"
_TIME = {"type": "object", "title": "time", "properties": {"sec": {"type": "integer"}, "nsec": {"type": "integer"}}}
_NUMBER = {"type": "number"}
_POSE = {"type": "object", "properties": {
    "position": {"type": "object", "properties": dict.fromkeys("xyz", _NUMBER)},
    "orientation": {"type": "object", "properties": dict.fromkeys("xyzw", _NUMBER)}}}
# Number of float32 in Foxglove's NumericType, and its bytes; a return has two, x and y.
_FLOAT32, _FLOAT_BYTES = 7, 4
_AXES = ("x", "y")
# Names of Foxglove's own schemas, by which its panels recognize a pose and a point cloud.
_SCHEMAS = {
    "foxglove.PoseInFrame": {"type": "object", "properties": {
        "timestamp": _TIME, "frame_id": {"type": "string"}, "pose": _POSE}},
    "foxglove.PointCloud": {"type": "object", "properties": {
        "timestamp": _TIME, "frame_id": {"type": "string"}, "pose": _POSE, "point_stride": {"type": "integer"},
        "fields": {"type": "array", "items": {"type": "object", "properties": {
            "name": {"type": "string"}, "offset": {"type": "integer"}, "type": {"type": "integer"}}}},
        "data": {"type": "string", "contentEncoding": "base64"}}},
    "mtr.Event": {"type": "object", "properties": {
        "timestamp": _TIME, "kind": {"type": "string"}, "values": {"type": "object"}}}}
_TOPICS = {_ROBOT: "foxglove.PoseInFrame", _KEY: "foxglove.PoseInFrame", _EVENTS: "mtr.Event",
           _SCANS: "foxglove.PointCloud"}


class _Entry(NamedTuple):
    topic: str
    time_ns: int
    values: dict[str, Any]


def mcap_of(course: pathlib.Path, scans: Iterable[Scan] = ()) -> bytes:
    """Return the file of one run. Times are the robot's, positions in the Car coordinate system, except returns of a
    robot without a known pose. ProgressFileError for a damaged course."""
    file = io.BytesIO()
    writer = Writer(file, compression=CompressionType.NONE)
    writer.start(profile="", library="mtr-operator")
    schemas = {name: writer.register_schema(name, "jsonschema", json.dumps(schema).encode("utf-8"))
               for name, schema in _SCHEMAS.items()}
    channels = {topic: writer.register_channel(topic, _ENCODING, schemas[name]) for topic, name in _TOPICS.items()}
    entries = sorted([*_entries(course), *map(_cloud, scans)], key=lambda entry: entry.time_ns)
    for number, entry in enumerate(entries):
        writer.add_message(channels[entry.topic], entry.time_ns, json.dumps(entry.values).encode("utf-8"),
                           entry.time_ns, number)
    writer.finish()
    return file.getvalue()


def _entries(course: pathlib.Path) -> Iterator[_Entry]:
    now_s = 0.0
    for each in read_course(course):
        if isinstance(each, Moment):
            now_s = each.status.stamp_s
            if each.status.pose_valid:
                yield from _poses(each.status)
        else:
            yield _entry(_EVENTS, now_s, kind=each.kind, values=dict(each.values))


def _poses(status: RobotStatus) -> Iterator[_Entry]:
    key_x, key_y = status.key_place
    height_m = 0.0 if math.isnan(status.key_height_m) else status.key_height_m
    for topic, (x, y, z) in ((_ROBOT, (status.x, status.y, 0.0)), (_KEY, (key_x, key_y, height_m))):
        yield _entry(topic, status.stamp_s, frame_id=_FRAME, pose=_pose(x, y, z, status.heading))


def _cloud(scan: Scan) -> _Entry:
    """Return the scan relative to the robot, with the robot's pose."""
    packed = struct.pack(f"<{len(_AXES) * len(scan.points)}f", *(value for point in scan.points for value in point))
    x, y, heading = scan.pose or (0.0, 0.0, 0.0)
    return _entry(_SCANS, scan.time_s, frame_id=_FRAME if scan.pose else _ROBOT_FRAME, pose=_pose(x, y, 0.0, heading),
                  point_stride=len(_AXES) * _FLOAT_BYTES, data=base64.b64encode(packed).decode("ascii"),
                  fields=[{"name": name, "offset": index * _FLOAT_BYTES, "type": _FLOAT32}
                          for index, name in enumerate(_AXES)])


def _pose(x: float, y: float, z: float, heading_rad: float) -> dict[str, Any]:
    half = heading_rad / 2.0
    return {"position": {"x": x, "y": y, "z": z},
            "orientation": {"x": 0.0, "y": 0.0, "z": math.sin(half), "w": math.cos(half)}}


def _entry(topic: str, time_s: float, **values: Any) -> _Entry:
    time_ns = max(round(time_s * _NS_PER_S), 0)
    seconds, nanoseconds = divmod(time_ns, _NS_PER_S)
    return _Entry(topic, time_ns, {"timestamp": {"sec": seconds, "nsec": nanoseconds}, **values})
