"""Fit of the Car to the output files of localization's replay."""
# SPDX-License-Identifier: Apache-2.0
import csv
import json
import math
import pathlib
from itertools import takewhile
from typing import Iterable, List, Optional, Sequence

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2

from .find.fit import fit_car
from .find.prior import Prior, prior_at, prior_from_start
from .measure.car_fit import CarFit
from .measure.close_up import CloseUp, WayRound
from .parameters import LocatorParameters
from .poses import PoseHistory, RobotPose
from .rectangle import Rectangle
from .scan import RangeBias, Scan, returns_in_map
from .surfels import surfels_from

SURFACES, SURFACE_COLUMNS = "surfaces.csv", ("x_m", "y_m", "normal_rad", "length_m", "sigma_m", "hits")
KEY_FRAMES, KEY_FRAME_COLUMNS = "key_frames.csv", ("stamp_s", "x_m", "y_m", "heading_rad")
TRAJECTORY, TRAJECTORY_COLUMNS = "trajectory.csv", ("stamp_s", "x_m", "y_m", "heading_rad", "valid", "map_revision")
SUMMARY, FRONT_BIAS, REAR_BIAS = "summary.json", "range_bias_m", "rear_range_bias_m"
DEFAULTS = LocatorParameters()


class FilesUnusable(RobotError):
    """A file is missing or incomplete; the text has the details."""


def fit_files(folder: pathlib.Path, prior: Optional[Pose2] = None, parameters: LocatorParameters = DEFAULTS,
              scans: Iterable[Scan] = ()) -> CarFit:
    """Return the Car in map from surfaces.csv; prior is its guessed pose in map.

    Without a prior, the first pose in key_frames.csv is the starting place. The drive's scans, in the order of their
    times, make the size more accurate. Raises NotLocated without a trustworthy Car, FilesUnusable for an unusable file.
    """
    folder = pathlib.Path(folder)
    surfels = surfels_from(_table(folder / SURFACES, SURFACE_COLUMNS))
    guess = _prior(folder, prior, parameters)
    return fit_car(surfels, guess, parameters, close_up_of(folder, scans, guess.car.pose))


def close_up_of(folder: pathlib.Path, scans: Iterable[Scan], car: Pose2) -> Optional[CloseUp]:
    """Return the returns near the Car between the first and the last key-frame; None without scans."""
    frames = _table(folder / KEY_FRAMES, KEY_FRAME_COLUMNS)
    if len(frames) == 0:
        return None
    way = WayRound(car.x, car.y)
    history: Optional[PoseHistory] = None
    rows, row = None, 0
    for scan in scans:
        end_s = scan.start_s + len(scan.ranges_m) * scan.beam_period_s
        if end_s > frames[-1, 0]:
            break
        if rows is None:
            rows = _table(folder / TRAJECTORY, TRAJECTORY_COLUMNS, frames[-1, 0])
        while row < len(rows) and (row == 0 or rows[row - 1, 0] < end_s):
            history = _with_pose(history, rows[row])
            row += 1
        seen = returns_in_map(scan, history) if history else None
        if seen is not None:
            way.add(seen, scan.base_from_lidar)
    return way.sweeps().close_up(frames, _range_bias(folder)) if rows is not None else None


def _with_pose(history: Optional[PoseHistory], row: FloatArray) -> Optional[PoseHistory]:
    time_s, x, y, heading, valid, map_revision = row
    if valid <= 0.5:
        return history
    robot = RobotPose(time_s, Pose2(x, y, heading), map_revision=int(map_revision))
    if history is None:
        return PoseHistory(robot)
    history.add(robot)
    return history


def _range_bias(folder: pathlib.Path) -> RangeBias:
    path = folder / SUMMARY
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
        front = float(summary[FRONT_BIAS])
        # Older files have one bias for both LiDARs.
        return RangeBias(front, float(summary.get(REAR_BIAS, front)))
    except OSError as error:
        raise FilesUnusable(f"{path} cannot be read: {error.strerror}.") from None
    except (AttributeError, KeyError, TypeError, ValueError):
        raise FilesUnusable(f"{path} has no number {FRONT_BIAS}.") from None


def summary_of(fit: CarFit) -> List[str]:
    """Return a summary of the Car for a person."""
    car, (x, y, heading) = fit.rectangle, fit.sigmas
    plane = ", ".join(f"{name} {size:.4f} m (1 sigma {sigma:.4f} m)" for name, size, sigma in (
        ("length", fit.in_plane.length, fit.in_plane.length_sigma),
        ("width", fit.in_plane.width, fit.in_plane.width_sigma)) if size is not None)
    return [f"x {car.pose.x:.4f} m, y {car.pose.y:.4f} m, heading {car.pose.heading:.5f} rad in map",
            f"1 sigma along {x:.4f} m, across {y:.4f} m, heading {heading:.5f} rad",
            f"length {car.length:.4f} m (1 sigma {fit.length_sigma:.4f} m)",
            f"width {car.width:.4f} m (1 sigma {fit.width_sigma:.4f} m)",
            f"in the LiDARs' plane: {plane or 'no size'}", *([fit.warning] if fit.warning else []),
            f"seen: {', '.join(fit.seen)}{' (by its wheels)' if fit.by_wheels else ''}; likeness {fit.quality:.2f}"]


def _prior(folder: pathlib.Path, car: Optional[Pose2], parameters: LocatorParameters) -> Prior:
    if car is not None:
        return prior_at(Rectangle(car, parameters.sheet.length_m, parameters.sheet.width_m))
    frames = _table(folder / KEY_FRAMES, KEY_FRAME_COLUMNS)
    if len(frames) == 0:
        raise FilesUnusable(f"{folder / KEY_FRAMES} has no key-frame, so where the robot started is not known.")
    return prior_from_start(Pose2(*frames[0, 1:]), parameters)


def _table(path: pathlib.Path, columns: Sequence[str], maximum: float = math.inf) -> FloatArray:
    """Return columns of a file with a header, up to the row whose first one is above the maximum.

    Lines that begin with # are skipped.
    """
    try:
        with path.open(newline="", encoding="utf-8") as lines:
            rows = csv.DictReader(line for line in lines if not line.startswith("#"))
            numbers = ([float(row[name]) for name in columns] for row in rows)
            return np.array(list(takewhile(lambda row: row[0] <= maximum, numbers))).reshape(-1, len(columns))
    except OSError as error:
        raise FilesUnusable(f"{path} cannot be read: {error.strerror}.") from None
    except (KeyError, TypeError, ValueError):
        raise FilesUnusable(f"{path} lacks numbers in one of the columns {', '.join(columns)}.") from None
