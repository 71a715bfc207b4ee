"""Settings that the application remembers between two starts."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import pathlib
from dataclasses import dataclass, field
from typing import Any

from mtr_operator.domain.errors import InvalidIdentity
from mtr_operator.domain.identity.identity import NOBODY, Identity
from mtr_operator.domain.identity.identity_document import identity_from
from mtr_operator.domain.results.document import read_record
from mtr_operator.storage.given_files import GivenPaths

from .connection import BusChoice, CanChoice, Connection, RobotChoice

FORMAT = "mtr-operator settings"
VERSION = 1
REMEMBERED_HOSTS = 8
REMEMBERED_CARS = 100
# Larger than any parameter.
_LARGEST = 1e12
# Maximum characters of a word to choose.
_LONGEST = 100
THEMES = ("system", "light", "dark", "contrast")
LANGUAGES = ("system", "en", "cs")


class NotSettings(ValueError):
    """Document without settings of this version."""


@dataclass(frozen=True)
class Settings:
    """Settings, replaced as a whole by each change.

    Attributes:
        connection: the last successful one. hosts: robots of earlier successes, newest first.
        result_folder, progress_folder: destinations of files.
        parameters: last used ones by scenario, as in a parameter file.
        limits: last used limits files by scenario. calibration: record of the robot, None for the design's. unfinished:
        progress file of an unfinished test.
        has_sounds: the application beeps at alerts. speaks: it also announces them.
        identity: of the previous test, as far as the next one may share it. identity_day: when it was typed. cars:
        measured ones with their VIN, and their keys, newest first.
    """

    connection: Connection = Connection()
    hosts: tuple[str, ...] = ()
    theme: str = "system"
    language: str = "system"
    result_folder: pathlib.Path = pathlib.Path("~/mtr-operator/results").expanduser()
    progress_folder: pathlib.Path = pathlib.Path("~/mtr-operator/progress").expanduser()
    parameters: dict[str, dict[str, Any]] = field(default_factory=dict)
    unfinished: pathlib.Path | None = None
    limits: dict[str, pathlib.Path] = field(default_factory=dict)
    calibration: pathlib.Path | None = None
    has_sounds: bool = True
    identity: Identity = NOBODY
    identity_day: str = ""
    cars: tuple[Identity, ...] = ()
    speaks: bool = False

    def with_car(self, identity: Identity) -> Settings:
        """Return settings that remember a car and its key by the car's VIN; unchanged without one."""
        if not identity.car_vin:
            return self
        others = (car for car in self.cars if car.car_vin != identity.car_vin)
        return dataclasses.replace(self, cars=(identity.of_its_car(), *others)[:REMEMBERED_CARS])

    def with_connection(self, connection: Connection) -> Settings:
        """Return settings after a success with this connection."""
        # Unencrypted links and normal mode on the Car's bus must be chosen again at each start.
        can = None if connection.can is None else dataclasses.replace(connection.can, is_normal=False)
        connection = dataclasses.replace(connection, robot=dataclasses.replace(connection.robot, is_unencrypted=False),
                                         can=can)
        host = connection.robot.host
        hosts = (host, *(other for other in self.hosts if other != host))[:REMEMBERED_HOSTS]
        return dataclasses.replace(self, connection=connection, hosts=hosts)

    def with_parameters(self, scenario: str, parameters: dict[str, Any]) -> Settings:
        """Return settings that remember a scenario's parameters."""
        return dataclasses.replace(self, parameters={**self.parameters, scenario: parameters})

    def given(self, scenario: str) -> GivenPaths:
        """Return the last files of a scenario."""
        return GivenPaths(self.limits.get(scenario), self.calibration)

    def with_given(self, scenario: str, paths: GivenPaths) -> Settings:
        """Return settings that remember the files of a scenario."""
        others = {name: path for name, path in self.limits.items() if name != scenario}
        limits = others if paths.limits is None else {**others, scenario: paths.limits}
        return dataclasses.replace(self, limits=limits, calibration=paths.calibration)

    def to_document(self) -> dict[str, Any]:
        """Return plain values for a file."""
        return {
            "format": FORMAT, "version": VERSION, **dataclasses.asdict(self), "hosts": list(self.hosts),
            "result_folder": str(self.result_folder), "progress_folder": str(self.progress_folder),
            "unfinished": None if self.unfinished is None else str(self.unfinished),
            "limits": {name: str(path) for name, path in self.limits.items()},
            "calibration": None if self.calibration is None else str(self.calibration),
            "identity": self.identity.to_document(), "cars": [car.to_document() for car in self.cars]}


def settings_from_document(document: Any) -> Settings:
    """Return the settings in a file; NotSettings if it has none."""
    if not isinstance(document, dict) or document.get("format") != FORMAT or document.get("version") != VERSION:
        raise NotSettings("They are of another format or version.")
    try:
        connection = document["connection"]
        can = connection["can"]
        return Settings(
            Connection(read_record(RobotChoice, connection["robot"]), None if can is None else _can(can)),
            tuple(str(host) for host in document["hosts"])[:REMEMBERED_HOSTS],
            _one_of(THEMES, document["theme"]), _one_of(LANGUAGES, document["language"]),
            _path(document["result_folder"]), _path(document["progress_folder"]),
            {str(name): _remembered(values) for name, values in document["parameters"].items()},
            _path_or_none(document["unfinished"]),
            # Earlier versions lack these.
            {str(name): _path(path) for name, path in document.get("limits", {}).items()},
            _path_or_none(document.get("calibration")), _flag(document.get("has_sounds", True)),
            identity_from(document.get("identity", {})), _text(document.get("identity_day", "")),
            tuple(identity_from(car).of_its_car() for car in document.get("cars", ()))[:REMEMBERED_CARS],
            _flag(document.get("speaks", False)))
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError, InvalidIdentity):
        raise NotSettings("They are damaged.") from None


def _can(document: Any) -> CanChoice:
    first = {name: value for name, value in document.items() if name != "further"}
    # An earlier version had only one bus.
    further = tuple(read_record(BusChoice, each) for each in document.get("further", ()))
    return dataclasses.replace(read_record(CanChoice, first), further=further)


def _path(text: Any) -> pathlib.Path:
    if not isinstance(text, str) or "\0" in text:
        raise TypeError("path")
    return pathlib.Path(text)


def _path_or_none(text: Any) -> pathlib.Path | None:
    return None if text is None else _path(text)


def _remembered(values: Any) -> dict[str, Any]:
    """Return remembered parameters; those that no longer match a scenario are detected at their use."""
    known = {str(name): value for name, value in values.items()}
    each = [item for value in known.values() for item in (isinstance(value, list) and value or [value])]
    if not all(value is None or (isinstance(value, (bool, int, float)) and abs(value) < _LARGEST)
               or (isinstance(value, str) and len(value) <= _LONGEST) for value in each):
        raise TypeError("parameters")
    return known


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError("text")
    return value


def _flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise TypeError("flag")
    return value


def _one_of(allowed: tuple[str, ...], value: Any) -> str:
    if value not in allowed:
        raise NotSettings("They are damaged.")
    return str(value)
