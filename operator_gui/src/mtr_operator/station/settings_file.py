"""File of the settings, in the system's folder for it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import json
import os
import pathlib
import shutil
import sys
from typing import Any

import platformdirs

from mtr_operator.domain.errors import OutputError
from mtr_operator.storage.atomic import write_bytes
from mtr_operator.storage.identity_file import LABORATORY_NAME

from .settings import NotSettings, Settings, settings_from_document

FOLDER_NAME = "mtr-operator"
FILE_NAME = "settings.json"
PROFILE_FOLDER_NAME = "cars"
_MAX_BYTES = 256 * 1024


def default_path() -> pathlib.Path:
    """Return the system's path for a person's settings; on Windows it roams to other computers."""
    return platformdirs.user_config_path(FOLDER_NAME, appauthor=False, roaming=True) / FILE_NAME


def laboratory_path(settings: pathlib.Path | None = None) -> pathlib.Path:
    """Return the path of a laboratory's requirements on each test, next to these settings."""
    return (settings or default_path()).with_name(LABORATORY_NAME)


def former_path() -> pathlib.Path:
    """Return the path of version 0.1: %APPDATA% on Windows, XDG's configuration folder elsewhere."""
    if sys.platform == "win32":
        base = pathlib.Path(os.environ.get("APPDATA") or pathlib.Path.home() / "AppData" / "Roaming")
    else:
        base = pathlib.Path(os.environ.get("XDG_CONFIG_HOME") or pathlib.Path.home() / ".config")
    return base / FOLDER_NAME / FILE_NAME


class SettingsStore:
    """Settings that are on disk after each change.

    former: path of an earlier version; the file is moved from there once, if the new path does not exist.

    Attributes:
        settings: the current ones.
        problem: one sentence on a file that could not be read or written; empty otherwise.
    """

    def __init__(self, path: pathlib.Path, former: pathlib.Path | None = None):
        self._path = path
        self._former = former
        self.settings = Settings()
        self.problem = ""
        self._is_spoilt = False

    def load(self) -> None:
        """Read the file; without a valid one the defaults remain, and an invalid one is set aside before the first
        write."""
        path = self._moved_here()
        try:
            if path.stat().st_size > _MAX_BYTES:
                raise NotSettings(f"They are larger than {_MAX_BYTES // 1024} KiB.")
            self.settings = settings_from_document(json.loads(path.read_text(encoding="utf-8")))
        except FileNotFoundError:
            pass
        except (OSError, ValueError, ArithmeticError, RecursionError) as error:
            reason = str(error) if isinstance(error, NotSettings) else "They cannot be read."
            self._is_spoilt = True
            self.problem = f"The settings in {path} were not used. {reason}"

    def _moved_here(self) -> pathlib.Path:
        """Return the file to read: settings of an earlier version are moved first, or read at their old path."""
        former = self._former
        if former is None or self._path.exists() or not former.is_file():
            return self._path
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            shutil.move(former, self._path)
        except OSError:
            return former
        return self._path

    @property
    def laboratory_path(self) -> pathlib.Path:
        """The laboratory's file for these settings."""
        return laboratory_path(self._path)

    @property
    def profile_folder(self) -> pathlib.Path:
        """Return the folder of Car profiles that were learned here."""
        return self._path.with_name(PROFILE_FOLDER_NAME)

    def change(self, settings: Settings) -> None:
        """Use these settings from now on, and write them; a failure is stored in `problem` and does not interrupt."""
        self.settings = settings
        self.problem = ""
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            if self._is_spoilt:
                # Syntax errors of a person, or settings of a later version, which the person can fix.
                self._lay_aside()
            write_bytes(self._path, _text(settings.to_document()).encode("utf-8"))
        except (OSError, OutputError) as error:
            self.problem = f"The settings cannot be kept: {error}"


    def _lay_aside(self) -> None:
        """Rename an unusable file to a unique name, next to earlier ones."""
        if self._path.exists():
            names = (self._path.with_name(f"{FILE_NAME}.bad{count or ''}") for count in itertools.count())
            os.replace(self._path, next(name for name in names if not os.path.lexists(name)))
        self._is_spoilt = False


def _text(document: dict[str, Any]) -> str:
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"
