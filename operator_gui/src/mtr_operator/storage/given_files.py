"""Files that the Operator gives beside the parameters: limits of the test, calibration record of the robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Any, Callable, TypeVar

from mtr_operator.domain.errors import InvalidCalibration, InvalidLimits
from mtr_operator.domain.estimation.budget.calibration import CalibrationRecord
from mtr_operator.domain.estimation.budget.calibration_document import calibration_from
from mtr_operator.domain.verdict.limits import Limits
from mtr_operator.domain.verdict.limits_document import limits_from

from .plain_yaml import BadYaml, load_yaml

Given = TypeVar("Given")
DEFAULT_CALIBRATION = pathlib.Path(__file__).parent.parent / "calibration" / "default.yaml"


def load_limits(path: pathlib.Path) -> Limits:
    """Limits in a file; InvalidLimits says what is wrong with it."""
    return _load(path, "limits file", limits_from, InvalidLimits)


def load_calibration(path: pathlib.Path = DEFAULT_CALIBRATION) -> CalibrationRecord:
    """Calibration record in a file; InvalidCalibration says what is wrong with it."""
    return _load(path, "calibration record", calibration_from, InvalidCalibration)


def _load(path: pathlib.Path, kind: str, read: Callable[[Any], Given], refusal: type[Exception]) -> Given:
    try:
        document = load_yaml(path)
    except OSError as error:
        raise refusal(f"The {kind} {path} cannot be read: {error.strerror or error}.") from None
    except BadYaml as error:
        raise refusal(f"The {kind} {path} {error}.") from None
    try:
        return read(document)
    except refusal as error:
        raise refusal(f"{kind.capitalize()} {path}: {error}") from None
