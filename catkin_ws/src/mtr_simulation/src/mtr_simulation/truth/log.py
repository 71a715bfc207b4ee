"""Writes down what truly happened at the simulated Car: one line per event, complete on disk at once."""
# SPDX-License-Identifier: Apache-2.0
import csv
import pathlib
from typing import Protocol, Tuple, Union

from mtr_core.errors import ConfigurationError

FILE_NAME = "truth_events.csv"
HEADER = ("event", "robot_time_s", "key_x_m", "key_y_m", "key_z_m", "accepted")

Point = Tuple[float, float, float]


class EventLog(Protocol):
    """Takes the true events."""

    def lock_event(self, event: str, time_ns: int, key_xyz: Point) -> None:
        """The locks moved; event is unlocked or locked."""

    def press(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """A button's contact closed at time_ns."""

    def handle(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """A hand took the driver's handle."""

    def close(self) -> None:
        """No more comes."""


class NoTruthLog:
    """Takes true events and writes them nowhere."""

    def lock_event(self, event: str, time_ns: int, key_xyz: Point) -> None:
        """Nothing."""

    def press(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """Nothing."""

    def handle(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """Nothing."""

    def close(self) -> None:
        """Nothing."""


class TruthLog:
    """Appends events to truth_events.csv in a directory, which is made when it is missing.

    robot_time_s is the simulation's time of the event, key_* the Remote key in the true Car frame in m, accepted (0 or
    1, presses and handle requests only) whether the Car received it, or found the key in its zone.
    """

    def __init__(self, directory: Union[str, pathlib.Path]):
        self.path = pathlib.Path(directory) / FILE_NAME
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            # Line-buffered: a simulation that is killed leaves every event before its death.
            self._file = open(self.path, "w", newline="", encoding="utf-8", buffering=1)  # noqa: SIM115
        except OSError as error:
            raise ConfigurationError(f"The truth cannot be written to {self.path}: {error.strerror}.") from error
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._writer.writerow(HEADER)

    def lock_event(self, event: str, time_ns: int, key_xyz: Point) -> None:
        """The locks moved; event is unlocked or locked."""
        self._write(event, time_ns, key_xyz, "")

    def press(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """A button's contact closed at time_ns."""
        self._write("press", time_ns, key_xyz, int(accepted))

    def handle(self, time_ns: int, key_xyz: Point, accepted: bool) -> None:
        """A hand took the driver's handle."""
        self._write("handle", time_ns, key_xyz, int(accepted))

    def close(self) -> None:
        """Close the file; safe to call twice."""
        self._file.close()

    def _write(self, event: str, time_ns: int, key_xyz: Point, accepted: Union[int, str]) -> None:
        self._writer.writerow([event, f"{time_ns / 1e9:.9f}", *(f"{value:.6f}" for value in key_xyz), accepted])
