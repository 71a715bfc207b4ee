"""Test site from a YAML file, for any simulator.

Poses are lists [x in m, y in m, heading in deg] in world, except start_in_car, which is in frame car.
"""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math
import pathlib
from typing import Any, Callable, Dict, Mapping, Tuple

import yaml

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import parameters_from
from mtr_core.se2 import Pose2

from .cables import Cable
from .car_shape import CAR_SHAPES, CarShape
from .figures import FIGURES
from .scenario import SCENARIOS, Scenario
from .surroundings import Cone, ParkedCar, Pole, Walk, Wall

SUFFIXES = (".yaml", ".yml")


def chosen_scenario(name_or_path: str) -> Scenario:
    """Return the site of a shipped name or of a YAML file.

    Raises:
        ConfigurationError: the name or file is invalid.
    """
    if name_or_path in SCENARIOS:
        return SCENARIOS[name_or_path]
    path = pathlib.Path(name_or_path)
    if path.suffix not in SUFFIXES:
        raise ConfigurationError(f"Parameter scenario is '{name_or_path}'; allowed is {', '.join(SCENARIOS)}, or the "
                                 "path of a YAML file.")
    content = _read(path)
    try:
        return scenario_from(content)
    except ConfigurationError as error:
        raise ConfigurationError(f"Scenario {path}: {error}") from error


def scenario_from(content: Mapping[str, Any]) -> Scenario:
    """Return the site that a table describes; missing entries equal the shipped site `open`."""
    allowed = [item.name for item in dataclasses.fields(Scenario)]
    unknown = sorted(set(content) - set(allowed))
    if unknown:
        raise ConfigurationError(f"Entry {unknown[0]} is unknown; allowed are {', '.join(allowed)}.")
    numbers = parameters_from({name: value for name, value in content.items() if name not in _READERS}, Scenario)
    return dataclasses.replace(numbers, **{name: read(name, content[name]) for name, read in _READERS.items()
                                           if name in content})


def _pose(name: str, value: Any) -> Pose2:
    x, y, heading_deg = _figures(name, value, 3, 3)
    return Pose2(x, y, math.radians(heading_deg))


def _figures(name: str, value: Any, fewest: int, most: int) -> Tuple[float, ...]:
    """Return the given number of finite numbers."""
    right = isinstance(value, list) and fewest <= len(value) <= most and all(
        isinstance(each, (int, float)) and not isinstance(each, bool) and math.isfinite(each) for each in value)
    if not right:
        count = str(fewest) if fewest == most else f"{fewest} to {most}"
        raise ConfigurationError(f"Entry {name} is {value!r}; allowed is a list of {count} numbers.")
    return tuple(map(float, value))


def _shape(name: str, value: Any) -> CarShape:
    if isinstance(value, dict):
        return parameters_from(value, CarShape)
    if not isinstance(value, str) or value not in CAR_SHAPES:
        raise ConfigurationError(f"Entry {name} is {value!r}; allowed is {', '.join(CAR_SHAPES)}, or a table of sizes.")
    return CAR_SHAPES[value]


def _pole(name: str, value: Any) -> Pole:
    return Pole(*_figures(name, value, 2, 3))


def _cone(name: str, value: Any) -> Cone:
    return Cone(*_figures(name, value, 2, 4))


def _wall(name: str, value: Any) -> Wall:
    x, y, heading_deg, *sizes = _figures(name, value, 4, 5)
    return Wall(Pose2(x, y, math.radians(heading_deg)), *sizes)


def _cable(name: str, value: Any) -> Cable:
    x, y, heading_deg, *sizes = _figures(name, value, 3, 5)
    return Cable(Pose2(x, y, math.radians(heading_deg)), *sizes)


def _parked_car(name: str, value: Any) -> ParkedCar:
    table = _table(name, value, ("pose", "shape"))
    return ParkedCar(_pose(f"{name}.pose", table.get("pose")), _shape(f"{name}.shape", table.get("shape", "default")))


def _walk(name: str, value: Any) -> Walk:
    table = _table(name, value, ("start", "end", "speed_mps", "stands_s", "figure"))
    (x1, y1), (x2, y2) = (_figures(f"{name}.{end}", table.get(end), 2, 2) for end in ("start", "end"))
    more = {key: _figures(f"{name}.{key}", [table[key]], 1, 1)[0] for key in ("speed_mps", "stands_s") if key in table}
    figure = table.get("figure", "person")
    if figure not in tuple(FIGURES):
        raise ConfigurationError(f"Entry {name}.figure is {figure!r}; allowed is {', '.join(FIGURES)}.")
    return Walk((x1, y1), (x2, y2), figure=figure, **more)


def _list_of(read: Callable[[str, Any], Any]) -> Callable[[str, Any], Tuple[Any, ...]]:
    def read_all(name: str, value: Any) -> Tuple[Any, ...]:
        if not isinstance(value, list):
            raise ConfigurationError(f"Entry {name} is {value!r}; allowed is a list.")
        return tuple(read(f"{name}[{index}]", each) for index, each in enumerate(value))
    return read_all


def _table(name: str, value: Any, allowed: Tuple[str, ...]) -> Dict[str, Any]:
    if not isinstance(value, dict) or not set(value) <= set(allowed):
        raise ConfigurationError(f"Entry {name} is {value!r}; allowed is a table of {', '.join(allowed)}.")
    return value


_READERS: Dict[str, Callable[[str, Any], Any]] = {
    "car": _shape, "world_from_car": _pose, "start_in_car": _pose, "poles": _list_of(_pole), "cones": _list_of(_cone),
    "walls": _list_of(_wall), "cables": _list_of(_cable), "parked_cars": _list_of(_parked_car), "person": _walk,
}


def _read(path: pathlib.Path) -> Dict[str, Any]:
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"Scenario {path} cannot be read: {getattr(error, 'strerror', None) or error}.") \
            from error
    except (yaml.YAMLError, RecursionError) as error:
        raise ConfigurationError(f"Scenario {path} is not valid YAML.") from error
    if not isinstance(content, dict) or not all(isinstance(name, str) for name in content):
        raise ConfigurationError(f"Scenario {path} is no table of names and values.")
    return content
