"""The settings' file, in the folder that the system keeps for it."""
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
    """Where the system keeps what a person has set; it follows the person to another computer on Windows."""
    return platformdirs.user_config_path(FOLDER_NAME, appauthor=False, roaming=True) / FILE_NAME


def laboratory_path(settings: pathlib.Path | None = None) -> pathlib.Path:
    """Where a laboratory writes what it requires of each test: beside these settings."""
    return (settings or default_path()).with_name(LABORATORY_NAME)


def former_path() -> pathlib.Path:
    """Where version 0.1 kept it: %APPDATA% on Windows, XDG's configuration folder elsewhere."""
    if sys.platform == "win32":
        base = pathlib.Path(os.environ.get("APPDATA") or pathlib.Path.home() / "AppData" / "Roaming")
    else:
        base = pathlib.Path(os.environ.get("XDG_CONFIG_HOME") or pathlib.Path.home() / ".config")
    return base / FOLDER_NAME / FILE_NAME


class SettingsStore:
    """Settings that are on disk after each change.

    former: where an earlier version kept them; they are moved from there once, when nothing is in the new place.

    Attributes:
        settings: the present ones.
        problem: one sentence on a file that could not be read or written; empty when all is well.
    """

    def __init__(self, path: pathlib.Path, former: pathlib.Path | None = None):
        self._path = path
        self._former = former
        self.settings = Settings()
        self.problem = ""
        self._is_spoilt = False

    def load(self) -> None:
        """Read the file; without a good one the defaults stay, and a bad one is laid aside before anything is kept."""
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
        """The file to read: the settings of an earlier version are moved first, or read where they are."""
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
        """Where profiles of Cars are kept that were learned here."""
        return self._path.with_name(PROFILE_FOLDER_NAME)

    def change(self, settings: Settings) -> None:
        """Use these from now on, and write them; a failure stands in `problem` and stops nobody."""
        self.settings = settings
        self.problem = ""
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            if self._is_spoilt:
                # A comma too many, or settings of a later version: a person has written them, and can mend them.
                self._lay_aside()
            write_bytes(self._path, _text(settings.to_document()).encode("utf-8"))
        except (OSError, OutputError) as error:
            self.problem = f"The settings cannot be kept: {error}"


    def _lay_aside(self) -> None:
        """Keep an unusable file under a name of its own, beside those that were laid aside before."""
        if self._path.exists():
            names = (self._path.with_name(f"{FILE_NAME}.bad{count or ''}") for count in itertools.count())
            os.replace(self._path, next(name for name in names if not os.path.lexists(name)))
        self._is_spoilt = False


def _text(document: dict[str, Any]) -> str:
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"
