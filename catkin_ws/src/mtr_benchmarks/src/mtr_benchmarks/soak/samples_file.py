"""Writes the samples of a soak immediately, so that they remain if the soak is killed. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import csv
import pathlib
from dataclasses import astuple, fields
from types import TracebackType
from typing import Optional, Type

from .processes import Usage

COLUMNS = ("time_s", "process", *(field.name for field in fields(Usage)))


class SamplesFile:
    """CSV file with a line for each sample of a process; use as a context manager."""

    def __init__(self, path: pathlib.Path):
        path.parent.mkdir(parents=True, exist_ok=True)
        # Line buffering allows reading the file while the soak runs.
        self._file = path.open("w", encoding="utf-8", newline="", buffering=1)
        self._rows = csv.writer(self._file, lineterminator="\n")
        self._rows.writerow(COLUMNS)

    def __enter__(self) -> "SamplesFile":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self._file.close()

    def add(self, time_s: float, name: str, usage: Usage) -> None:
        """Add a sample of one process at a time of the robot, s."""
        self._rows.writerow((f"{time_s:.1f}", name, *(f"{value:.3f}" if isinstance(value, float) else value
                                                      for value in astuple(usage))))
