"""State of the Car for a restarted locator, and its conversion to plain data."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import asdict, dataclass
from typing import Any, Dict, Mapping

import numpy as np

from mtr_core import sensor_figures
from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2

from ..measure.car_fit import UNKNOWN_SIDES, CarFit, PlaneSize, SideSigmas
from ..rectangle import Rectangle
from ..scan import RangeBias
from ..surfels import Surfels

# Files of older versions do not have the bias that the surfels are corrected for; the sigma is from data sheets.
UNKNOWN_BIAS = RangeBias(sigma_m=sensor_figures.ASSUMED_RANGE_BIAS_M.value)


class MemoryUnusable(RobotError):
    """Stored data that cannot be read."""


@dataclass(frozen=True)
class RememberedCar:
    """A located Car.

    Attributes:
        map_revision: of the localization map, in whose frame it is.
        revision: of the Car's own frame.
        map_car_id: order to map that it answered.
    """

    fit: CarFit
    map_revision: int
    revision: int
    map_car_id: int


def plain(car: RememberedCar) -> Dict[str, Any]:
    """Convert the Car to lists, texts and numbers."""
    data = {name: value for name, value in vars(car).items() if name != "fit"}
    surfels = car.fit.surfels
    columns = (surfels.position, surfels.normal, surfels.length, surfels.sigma, surfels.hits)
    data["fit"] = {**asdict(car.fit), "surfels": np.column_stack(columns).tolist()}
    return data


def remembered_from(data: Mapping[str, Any]) -> RememberedCar:
    """Restore the Car from plain data.

    Raises:
        MemoryUnusable: the data do not describe a Car.
    """
    try:
        fit = dict(data["fit"])
        rectangle = fit.pop("rectangle")
        table = np.asarray(fit.pop("surfels"), dtype=float).reshape(-1, 7)
        found = CarFit(
            rectangle=Rectangle(Pose2(**rectangle.pop("pose")), **rectangle),
            outline=tuple((float(x), float(y)) for x, y in fit.pop("outline")),
            sigmas=tuple(fit.pop("sigmas")), seen=tuple(fit.pop("seen")),
            surfels=Surfels(table[:, 0:2], table[:, 2:4], table[:, 4], table[:, 5], table[:, 6]),
            in_plane=PlaneSize(**fit.pop("in_plane")),
            side_sigmas=SideSigmas(*map(float, fit.pop("side_sigmas", UNKNOWN_SIDES))),
            range_bias=RangeBias(*map(float, fit.pop("range_bias", UNKNOWN_BIAS))), **fit)
        return RememberedCar(found, int(data["map_revision"]), int(data["revision"]), int(data["map_car_id"]))
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise MemoryUnusable(f"The remembered Car is damaged ({error}); the Car has to be mapped again.") from None
