"""Selection of the simulated Car: gentle or honest, by a small file or the name of a shipped one."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import pathlib
from dataclasses import dataclass
from typing import Any, Dict, Mapping, Optional, Protocol, Tuple

import yaml

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import parameters_from

from ..truth.log import EventLog
from .can_port import CanPort
from .car import SimulatedCar
from .ecu import Command
from .honest.car import HonestCar
from .honest.parameters import HonestParameters, changed_antennas
from .parameters import CarParameters
from .reaction.gentle import GentleReactions
from .reaction.honest import HonestReactions
from .reaction.model import ReactionModel
from .vehicle import Vehicle

FOLDER = pathlib.Path(__file__).with_name("cars")
GENTLE, HONEST = "gentle", "honest"
_OTHERS = ("place_seed", "antennas")
_SECTIONS = {item.name: item.default for item in dataclasses.fields(HonestParameters) if item.name not in _OTHERS}
_HEADINGS = ("model", "description", "profile")


class Car(Protocol):
    """A Car in the simulation.

    Attributes:
        vehicle: reported ignition and speed.
    """

    vehicle: Vehicle

    def step(self, time_ns: int, key_xyz: Tuple[float, float, float], servo_us: Tuple[float, float],
             key_yaw_rad: float = 0.0) -> None:
        """Advance to time_ns, 20 ms after the previous step."""

    def request_handle(self, command: Command = Command.UNLOCK) -> None:
        """Simulate a hand that pulls the driver's handle."""


@dataclass(frozen=True)
class CarChoice:
    """One Car.

    Attributes:
        name: name of its file.
        profile: car profile of the Operator's application.
        honest: parameters of an honest Car; None for the gentle Car.
    """

    name: str
    profile: str
    honest: Optional[HonestParameters] = None

    def car(self, seed: int, port: CanPort, truth_log: EventLog) -> Car:
        """Return the simulated Car."""
        if self.honest is None:
            return SimulatedCar(seed, CarParameters(), port, truth_log)
        return HonestCar(seed, self.honest, port, truth_log)

    def reactions(self, seed: int) -> ReactionModel:
        """Return the reaction model, which is its truth."""
        return GentleReactions(seed, CarParameters()) if self.honest is None else HonestReactions(self.honest)


def car_names() -> Tuple[str, ...]:
    """Return the names of the shipped Cars."""
    return tuple(sorted(path.stem for path in FOLDER.glob("*.yaml")))


def chosen_car(name_or_path: str) -> CarChoice:
    """Return the Car of a shipped name or of a YAML file.

    Raises:
        ConfigurationError: the name or file is invalid.
    """
    return car_from(*car_content(name_or_path))


def car_content(name_or_path: str) -> Tuple[Dict[str, Any], pathlib.Path]:
    """Return the content of a Car's file and its path.

    Raises:
        ConfigurationError: the file cannot be read.
    """
    path = FOLDER / f"{name_or_path}.yaml"
    if name_or_path not in car_names():
        path = pathlib.Path(name_or_path)
        if path.suffix != ".yaml":
            raise ConfigurationError(f"Parameter car is '{name_or_path}'; allowed is {', '.join(car_names())}, or the "
                                     "path of a YAML file.")
    return _read(path), path


def car_from(content: Mapping[str, Any], path: pathlib.Path) -> CarChoice:
    """Return the Car of a file's content.

    Raises:
        ConfigurationError: the content is invalid; the text names the path.
    """
    content = dict(content)
    model, profile = content.pop("model", None), content.pop("profile", None)
    content.pop("description", None)
    if model not in (GENTLE, HONEST):
        raise ConfigurationError(f"Car {path}: model is {model!r}; allowed is {GENTLE} or {HONEST}.")
    if not isinstance(profile, str):
        raise ConfigurationError(f"Car {path} lacks the entry profile, the name of the application's car profile.")
    if model == GENTLE:
        if content:
            raise ConfigurationError(f"Car {path}: {min(content)} is no entry of the gentle Car; it has none but "
                                     f"{', '.join(_HEADINGS)}.")
        return CarChoice(path.stem, profile)
    return CarChoice(path.stem, profile, _honest(path, content))


def _honest(path: pathlib.Path, content: Dict[str, Any]) -> HonestParameters:
    place = {name: value for name, value in content.items() if name not in _SECTIONS}
    sections: Dict[str, Any] = {}
    try:
        for name, default in _SECTIONS.items():
            values = content.get(name) or {}
            if not isinstance(values, dict):
                raise ConfigurationError(f"Section {name} is {values!r}; allowed is a table of names and values.")
            sections[name] = parameters_from(values, type(default))
        antennas = place.pop("antennas", None) or {}
        if not isinstance(antennas, dict):
            raise ConfigurationError(f"Section antennas is {antennas!r}; allowed is a table of names and values.")
        sections["antennas"] = changed_antennas(antennas)
        unknown = sorted(set(place) - {"place_seed"})
        if unknown:
            allowed = ", ".join([*_HEADINGS, "place_seed", *_SECTIONS, "antennas"])
            raise ConfigurationError(f"Entry {unknown[0]} is unknown; allowed are {allowed}.")
        return dataclasses.replace(parameters_from(place, HonestParameters), **sections)
    except ConfigurationError as error:
        raise ConfigurationError(f"Car {path}: {error}") from error


def _read(path: pathlib.Path) -> Dict[str, Any]:
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"Car {path} cannot be read: {getattr(error, 'strerror', None) or error}.") from error
    except (yaml.YAMLError, RecursionError) as error:
        raise ConfigurationError(f"Car {path} is not valid YAML.") from error
    if not isinstance(content, dict) or not all(isinstance(name, str) for name in content):
        raise ConfigurationError(f"Car {path} is no table of names and values.")
    return content
