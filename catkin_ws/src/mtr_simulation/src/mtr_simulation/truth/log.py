"""Logs the true events of the simulated Car: one line per event, written to disk at once."""
# SPDX-License-Identifier: Apache-2.0
import csv
import pathlib
from typing import Protocol, Tuple, Union

from mtr_core.errors import ConfigurationError

FILE_NAME = "truth_events.csv"
HEADER = ("event", "robot_time_s", "key_x_m", "key_y_m", "key_z_m", "accepted")

Point = Tuple[float, float, float]


class EventLog(Protocol):
    """Receives the true events."""

    def lock_event(self, event: str, time_ns: int, key_xyz: Point) -> None:
        """Log a movement of the locks; event is unlocked or locked."""

    def press(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """Log a closing of a button's contact at time_ns."""

    def handle(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """Log a hand that pulled the driver's handle."""

    def close(self) -> None:
        """Close the log."""


class NoTruthLog:
    """Discards true events."""

    def lock_event(self, event: str, time_ns: int, key_xyz: Point) -> None:
        """Do nothing."""

    def press(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """Do nothing."""

    def handle(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""


class TruthLog:
    """Appends events to truth_events.csv in a directory, which is created if necessary.

    robot_time_s is the simulated time of the event, key_* the Remote key in the true Car frame in m. accepted (0 or 1,
    presses and handle requests only) is whether the Car received it, or found the key in its zone.
    """

    def __init__(self, directory: Union[str, pathlib.Path]):
        self.path = pathlib.Path(directory) / FILE_NAME
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            # Line-buffered: a simulation that is killed leaves every earlier event.
            self._file = open(self.path, "w", newline="", encoding="utf-8", buffering=1)  # noqa: SIM115
        except OSError as error:
            raise ConfigurationError(f"The truth cannot be written to {self.path}: {error.strerror}.") from error
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._writer.writerow(HEADER)

    def lock_event(self, event: str, time_ns: int, key_xyz: Point) -> None:
        """Log a movement of the locks; event is unlocked or locked."""
        self._write(event, time_ns, key_xyz, "")

    def press(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """Log a closing of a button's contact at time_ns."""
        self._write("press", time_ns, key_xyz, int(accepted))

    def handle(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """Log a hand that pulled the driver's handle."""
        self._write("handle", time_ns, key_xyz, int(accepted))

    def close(self) -> None:
        """Close the file; safe to call twice."""
        self._file.close()

    def _write(self, event: str, time_ns: int, key_xyz: Point, accepted: Union[int, str]) -> None:
        self._writer.writerow([event, f"{time_ns / 1e9:.9f}", *(f"{value:.6f}" for value in key_xyz), accepted])
