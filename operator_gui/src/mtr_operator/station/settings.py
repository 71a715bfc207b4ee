"""What the application remembers between two starts."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import pathlib
from dataclasses import dataclass, field
from typing import Any

from .connection import CanChoice, Connection, RobotChoice

FORMAT = "mtr-operator settings"
VERSION = 1
REMEMBERED_HOSTS = 8
THEMES = ("system", "light", "dark")
LANGUAGES = ("system", "en", "cs")


class NotSettings(ValueError):
    """A document that holds no settings of this version."""


@dataclass(frozen=True)
class Settings:
    """Replaced as a whole by each change.

    Attributes:
        connection: of the last success. hosts: robots of earlier successes, newest first.
        result_folder, progress_folder: where files go.
        parameters: last used ones by scenario, as in a parameter file.
        unfinished: progress file of a test that has not come to its end.
    """

    connection: Connection = Connection()
    hosts: tuple[str, ...] = ()
    theme: str = "system"
    language: str = "system"
    result_folder: pathlib.Path = pathlib.Path("~/mtr-operator/results").expanduser()
    progress_folder: pathlib.Path = pathlib.Path("~/mtr-operator/progress").expanduser()
    parameters: dict[str, dict[str, Any]] = field(default_factory=dict)
    unfinished: pathlib.Path | None = None

    def with_connection(self, connection: Connection) -> Settings:
        """Settings after a success with this connection."""
        host = connection.robot.host
        hosts = (host, *(other for other in self.hosts if other != host))[:REMEMBERED_HOSTS]
        return dataclasses.replace(self, connection=connection, hosts=hosts)

    def with_parameters(self, scenario: str, parameters: dict[str, Any]) -> Settings:
        """Settings that remember a scenario's parameters."""
        return dataclasses.replace(self, parameters={**self.parameters, scenario: parameters})

    def to_document(self) -> dict[str, Any]:
        """Plain values for a file."""
        return {
            "format": FORMAT, "version": VERSION, **dataclasses.asdict(self), "hosts": list(self.hosts),
            "result_folder": str(self.result_folder), "progress_folder": str(self.progress_folder),
            "unfinished": None if self.unfinished is None else str(self.unfinished)}


def settings_from_document(document: Any) -> Settings:
    """Settings in a file; NotSettings when they are not."""
    if not isinstance(document, dict) or document.get("format") != FORMAT or document.get("version") != VERSION:
        raise NotSettings("They are of another format or version.")
    try:
        connection = document["connection"]
        can = connection["can"]
        return Settings(
            Connection(RobotChoice(**connection["robot"]), None if can is None else CanChoice(**can)),
            tuple(str(host) for host in document["hosts"]),
            _one_of(THEMES, document["theme"]), _one_of(LANGUAGES, document["language"]),
            pathlib.Path(document["result_folder"]), pathlib.Path(document["progress_folder"]),
            {str(name): dict(values) for name, values in document["parameters"].items()},
            None if document["unfinished"] is None else pathlib.Path(document["unfinished"]))
    except (KeyError, TypeError, ValueError, AttributeError):
        raise NotSettings("They are damaged.") from None


def _one_of(allowed: tuple[str, ...], value: Any) -> str:
    if value not in allowed:
        raise NotSettings("They are damaged.")
    return str(value)
