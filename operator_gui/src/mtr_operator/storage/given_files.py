"""Files that the Operator gives beside the parameters: limits of the test, calibration record of the robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import pathlib
from typing import Any, Callable, NamedTuple, TypeVar

from mtr_operator.domain.errors import InvalidCalibration, InvalidLimits
from mtr_operator.domain.estimation.budget.calibration import CalibrationRecord
from mtr_operator.domain.estimation.budget.calibration_document import calibration_from
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.verdict.limits import Limits
from mtr_operator.domain.verdict.limits_document import limits_from

from .plain_yaml import BadYaml, load_yaml

Content = TypeVar("Content")
DEFAULT_CALIBRATION = pathlib.Path(__file__).parent.parent / "calibration" / "default.yaml"


def load_limits(path: pathlib.Path) -> Limits:
    """Limits in a file; InvalidLimits says what is wrong with it."""
    return _load(path, limits_from, InvalidLimits)


def load_calibration(path: pathlib.Path = DEFAULT_CALIBRATION) -> CalibrationRecord:
    """Calibration record in a file; InvalidCalibration says what is wrong with it."""
    return _load(path, calibration_from, InvalidCalibration)


def calibration_of(progress: Progress) -> CalibrationRecord:
    """With which a test was measured; the design's where its files are older than such records."""
    return _design() if progress.calibration is None else progress.calibration


@functools.lru_cache(maxsize=1)
def _design() -> CalibrationRecord:
    """A part of the program: read once."""
    return load_calibration()


class GivenPaths(NamedTuple):
    """Files that the Operator gives for a test; None where nothing is given."""

    limits: pathlib.Path | None = None
    calibration: pathlib.Path | None = None


class Given:
    """What the Operator gives for a test; the paths are None where nothing is given.

    InvalidLimits or InvalidCalibration says what is wrong with a file.
    """

    def __init__(self, limits: pathlib.Path | None = None, calibration: pathlib.Path | None = None):
        self.limits = None if limits is None else load_limits(limits)
        self.calibration = None if calibration is None else load_calibration(calibration)

    def give(self, progress: Progress) -> None:
        """To a test that begins."""
        progress.limits = self.limits
        progress.calibration = self.calibration or load_calibration()

    def compare(self, progress: Progress) -> None:
        """With those of a test that goes on: limits that are chosen after the measurement are none."""
        if self.limits is not None and self.limits != progress.limits:
            raise InvalidLimits("The test was begun with other limits, or with none; continue it without this file, or "
                                "begin a new test.")
        if self.calibration is not None and self.calibration != progress.calibration:
            raise InvalidCalibration("The test was begun with another calibration record of the robot; continue it "
                                     "without this file, or begin a new test.")


def _load(path: pathlib.Path, read: Callable[[Any], Content], refusal: type[Exception]) -> Content:
    try:
        document = load_yaml(path)
    except OSError as error:
        raise refusal(f"The file {path} cannot be read: {error.strerror or error}.") from None
    except BadYaml as error:
        raise refusal(f"The file {path} {error}.") from None
    try:
        return read(document)
    except refusal as error:
        raise refusal(f"In the file {path}: {error}") from None
