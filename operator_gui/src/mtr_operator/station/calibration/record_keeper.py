"""Stores the findings of a guided calibration in the record of the current robot, which the next tests use."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import datetime
import pathlib
from typing import Callable

from mtr_operator.domain.estimation.budget.calibration import CalibrationRecord
from mtr_operator.domain.estimation.budget.calibration_steps import Signed
from mtr_operator.storage.calibration_file import new_record, record_path, save_calibration
from mtr_operator.storage.given_files import load_calibration

from ..settings_file import SettingsStore

# Function that adds a finding to a record.
Change = Callable[[CalibrationRecord, Signed], CalibrationRecord]
FOLDER_NAME = "calibration"


class RecordKeeper:
    """Current record; each step is on disk when keep() returns."""

    def __init__(self, store: SettingsStore, today: Callable[[], datetime.date] = datetime.date.today):
        self._store = store
        self._today = today

    @property
    def path(self) -> pathlib.Path | None:
        """Path of the current record; None for the design's."""
        return self._store.settings.calibration

    def use(self, path: pathlib.Path | None) -> None:
        """Switch to another record, or start a new one; InvalidCalibration states a fault of the file."""
        if path is not None:
            load_calibration(path)
        self._store.change(dataclasses.replace(self._store.settings, calibration=path))

    def record(self) -> CalibrationRecord | None:
        """Return the current record; None without one. InvalidCalibration states a fault of the file."""
        return None if self.path is None else load_calibration(self.path)

    def keep(self, change: Change, robot: str, by: str) -> pathlib.Path:
        """Add a finding to the record of the robot, which the next tests then use; return its path.

        InvalidCalibration or OutputError states why it cannot be stored.
        """
        today, path = self._today(), self.path
        if path is None:
            path = record_path(self._store.settings.result_folder.parent / FOLDER_NAME, robot)
        record = load_calibration(path) if path.exists() else new_record(robot, by, today)
        save_calibration(path, change(record, Signed(today, by)))
        self._store.change(dataclasses.replace(self._store.settings, calibration=path))
        return path
