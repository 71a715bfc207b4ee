"""The Car from the files that localization's replay of a recorded drive leaves."""
# SPDX-License-Identifier: Apache-2.0
import csv
import pathlib
from typing import List, Optional, Sequence

import numpy as np

from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2

from .car_fit import CarFit
from .fit import fit_car
from .parameters import LocatorParameters
from .prior import Prior, prior_at, prior_from_start
from .rectangle import Rectangle
from .surfels import surfels_from

SURFACES, SURFACE_COLUMNS = "surfaces.csv", ("x_m", "y_m", "normal_rad", "length_m", "sigma_m", "hits")
KEY_FRAMES, KEY_FRAME_COLUMNS = "key_frames.csv", ("x_m", "y_m", "heading_rad")
DEFAULTS = LocatorParameters()


class FilesUnusable(RobotError):
    """A file is missing or lacks what is needed; the text says which and what."""


def fit_files(folder: pathlib.Path, prior: Optional[Pose2] = None,
              parameters: LocatorParameters = DEFAULTS) -> CarFit:
    """The Car in map from surfaces.csv; prior is its guessed pose in map.

    Without a prior the first pose in key_frames.csv counts as the starting place. NotLocated when there is no Car that
    can be trusted, FilesUnusable when a file cannot be used.
    """
    folder = pathlib.Path(folder)
    surfels = surfels_from(_table(folder / SURFACES, SURFACE_COLUMNS))
    return fit_car(surfels, _prior(folder, prior, parameters), parameters)


def summary_of(fit: CarFit) -> List[str]:
    """The Car in a few lines for a person."""
    car, (x, y, heading) = fit.rectangle, fit.sigmas
    return [f"x {car.pose.x:.4f} m, y {car.pose.y:.4f} m, heading {car.pose.heading:.5f} rad in map",
            f"1 sigma along {x:.4f} m, across {y:.4f} m, heading {heading:.5f} rad",
            f"length {car.length:.4f} m (1 sigma {fit.length_sigma:.4f} m)",
            f"width {car.width:.4f} m (1 sigma {fit.width_sigma:.4f} m)",
            f"seen: {', '.join(fit.seen)}{' (by its wheels)' if fit.by_wheels else ''}; likeness {fit.quality:.2f}"]


def _prior(folder: pathlib.Path, car: Optional[Pose2], parameters: LocatorParameters) -> Prior:
    if car is not None:
        return prior_at(Rectangle(car, parameters.profile.length_m, parameters.profile.width_m))
    frames = _table(folder / KEY_FRAMES, KEY_FRAME_COLUMNS)
    if len(frames) == 0:
        raise FilesUnusable(f"{folder / KEY_FRAMES} has no key-frame, so where the robot started is not known.")
    return prior_from_start(Pose2(*frames[0]), parameters)


def _table(path: pathlib.Path, columns: Sequence[str]) -> np.ndarray:
    """The wanted columns of a file with a header; lines that begin with # are skipped."""
    try:
        with path.open(newline="", encoding="utf-8") as lines:
            rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        return np.array([[float(row[name]) for name in columns] for row in rows]).reshape(-1, len(columns))
    except OSError as error:
        raise FilesUnusable(f"{path} cannot be read: {error.strerror}.") from None
    except (KeyError, TypeError, ValueError):
        raise FilesUnusable(f"{path} lacks numbers in one of the columns {', '.join(columns)}.") from None
