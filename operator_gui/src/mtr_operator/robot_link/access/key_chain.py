"""This laptop's key pair and the paired robots' public keys, in files for their owner alone."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import json
import os
import pathlib
from dataclasses import dataclass
from typing import Any

import platformdirs
import zmq

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.results.document import read_record
from mtr_proto.keys import (
    KeyPair,
    LinkKeyError,
    check_writers,
    is_key,
    own_key_pair,
    private_folder,
    write_private,
)
from mtr_proto.pairing import ROLES

CONTROLLER, VIEWER = ROLES
FOLDER_NAME = "link"
OWN_KEYS, ROBOTS = "station.key", "robots.json"
MAX_ROBOTS = 64
_MAX_BYTES = 64 * 1024
_FORMAT = "mtr-operator robots"
_VERSION = 1


@dataclass(frozen=True)
class PairedRobot:
    """Robot with a known key. host: address at the time of pairing. key: Z85. date: ISO 8601."""

    host: str
    key: str
    role: str
    date: str


def default_folder() -> pathlib.Path:
    """Return the system's folder for local program data; it does not roam with the user's profile."""
    return platformdirs.user_data_path("mtr-operator", appauthor=False) / FOLDER_NAME


class KeyChain:
    """Keys in a folder. folder: None for the system's."""

    def __init__(self, folder: pathlib.Path | None = None):
        self._folder = folder or default_folder()

    def own_keys(self) -> KeyPair:
        """Return the key pair, created at the first call; ConnectionFailed states why it cannot be used."""
        try:
            return own_key_pair(self._folder / OWN_KEYS, zmq.curve_keypair)
        except LinkKeyError as error:
            raise ConnectionFailed(str(error)) from None

    def robots(self) -> tuple[PairedRobot, ...]:
        """Return all paired robots, newest first; ConnectionFailed if the file is damaged or writable by others."""
        path = self._folder / ROBOTS
        try:
            check_writers(self._folder, self._folder.stat())
            with open(path, encoding="utf-8") as file:
                check_writers(path, os.fstat(file.fileno()))
                document = json.loads(file.read(_MAX_BYTES))
            return _robots_in(document)
        except FileNotFoundError:
            return ()
        except LinkKeyError as error:
            raise ConnectionFailed(str(error)) from None
        except OSError as error:
            raise ConnectionFailed(f"The list of paired robots {path} cannot be read: {error.strerror}.") from None
        except (ValueError, TypeError, LookupError, AttributeError, RecursionError):
            raise ConnectionFailed(f"The list of paired robots {path} is damaged; delete it and pair anew.") from None

    def robots_at(self, host: str) -> tuple[PairedRobot, ...]:
        """Return the robots that were paired at this address, newest first: hotspots of two robots have the same
        address."""
        return tuple(robot for robot in self.robots() if robot.host == host)

    def keep(self, robot: PairedRobot) -> None:
        """Store a robot; it replaces an entry with the same address and key."""
        others = [each for each in self.robots() if (each.host, each.key) != (robot.host, robot.key)]
        self._write((robot, *others[:MAX_ROBOTS - 1]))

    def forget(self, host: str) -> int:
        """Remove the robots at this address; return their number."""
        robots = self.robots()
        kept = tuple(robot for robot in robots if robot.host != host)
        if len(kept) < len(robots):
            self._write(kept)
        return len(robots) - len(kept)

    def _write(self, robots: tuple[PairedRobot, ...]) -> None:
        document = {"format": _FORMAT, "version": _VERSION, "robots": [dataclasses.asdict(robot) for robot in robots]}
        try:
            write_private(private_folder(self._folder) / ROBOTS, json.dumps(document, indent=1) + "\n")
        except LinkKeyError as error:
            raise ConnectionFailed(str(error)) from None
        except OSError as error:
            raise ConnectionFailed(f"The list of paired robots cannot be written to {self._folder}: "
                                   f"{error.strerror}.") from None


def _robots_in(document: Any) -> tuple[PairedRobot, ...]:
    if document["format"] != _FORMAT or document["version"] != _VERSION:
        raise ValueError("another format")
    robots = tuple(read_record(PairedRobot, item) for item in document["robots"])
    if not all(is_key(robot.key) and robot.role in ROLES for robot in robots):
        raise ValueError("no key")
    return robots
