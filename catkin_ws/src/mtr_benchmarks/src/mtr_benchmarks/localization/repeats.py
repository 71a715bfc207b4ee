"""Repeats drives that proved nothing with another seed, and reports the repetitions."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, List, Tuple, Type

from .drives.selection import BenchmarkDrive, repeated
from .methods.outcome import THIS_SYSTEM
from .methods.this_system import SystemFailure
from .one_drive import RECORDING, DriveResult

MAX_DRIVES = 5


def run_until_it_proves(drive: BenchmarkDrive, once: Callable[[BenchmarkDrive], DriveResult],
                        proves_nothing: Tuple[Type[Exception], ...]) -> DriveResult:
    """Return the result of the drive, or of its first repetition without one of the errors; at most MAX_DRIVES
    drives."""
    tried = drive
    repeats: List[str] = []
    for _ in range(MAX_DRIVES):
        try:
            return once(tried)._replace(repeats=repeats)
        except proves_nothing as error:
            repeats.append(f"{tried.name}: {error}")
            tried = repeated(tried)
        except SystemFailure as error:
            return DriveResult(tried, {}, {THIS_SYSTEM: str(error)}, [], repeats=repeats)
    return DriveResult(drive, {}, {RECORDING: f"{MAX_DRIVES} drives gave nothing. {repeats[-1]}"}, [], repeats=repeats)
