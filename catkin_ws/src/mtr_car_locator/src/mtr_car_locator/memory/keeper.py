"""Background storage of the located Car in a file."""
# SPDX-License-Identifier: Apache-2.0
import concurrent.futures
from typing import Any, Callable, Dict, Optional, Tuple

from mtr_core.states import CarState

from ..estimate import Estimate
from .memory_file import MemoryFile
from .remembered import MemoryUnusable, RememberedCar, plain, remembered_from


class CarKeeper:
    """Reads the stored Car of this run at the start, and writes each new frame of the Car.

    file: None disables storage. executor: for a disk that must not delay ticks. warn: receives sentences for the log.
    """

    def __init__(self, file: Optional[MemoryFile], executor: concurrent.futures.Executor,
                 warn: Callable[[str], object]):
        self._file, self._executor, self._warn = file, executor, warn
        self._kept: Optional[Tuple[int, int, int]] = None

    def read(self) -> Optional[RememberedCar]:
        """Return the previous Car; None without a usable file."""
        try:
            data = self._file.read() if self._file else None
            car = remembered_from(data) if data else None
        except MemoryUnusable as error:
            self._warn(str(error))
            return None
        if car:
            self._warn(f"The Car locator was started anew; it goes on with the Car of before, revision {car.revision}.")
        return car

    def note(self, estimate: Estimate) -> None:
        """Store the Car of an estimate if its frame is new; delete it if it is no longer located."""
        car = _remembered(estimate)
        frame = (car.map_revision, car.map_car_id, car.revision) if car else None
        if frame != self._kept and self._file is not None:
            self._kept = frame
            self._executor.submit(self._write, self._file, plain(car) if car else None)

    def _write(self, file: MemoryFile, data: Optional[Dict[str, Any]]) -> None:
        try:
            file.write(data)
        except MemoryUnusable as error:
            self._warn(str(error))


def _remembered(estimate: Estimate) -> Optional[RememberedCar]:
    if estimate.state != CarState.LOCATED or estimate.fit is None:
        return None
    return RememberedCar(estimate.fit, estimate.map_revision, estimate.revision, estimate.map_car_id)
