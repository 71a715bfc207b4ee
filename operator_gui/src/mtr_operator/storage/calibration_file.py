"""The calibration record of a robot on disk: begun from the design's, and changed step by step."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import datetime
import pathlib
import re

import yaml

from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.estimation.budget.calibration import CalibrationRecord
from mtr_operator.domain.estimation.budget.calibration_document import calibration_from
from mtr_operator.domain.identity.file_name import to_file_name

from .atomic import write_bytes
from .given_files import load_calibration

# How long a record of a robot in daily use is to be believed.
VALID_DAYS = 365
_NO_FILE_NAME = re.compile(r"[^\w.-]+")


def new_record(robot: str, by: str, today: datetime.date) -> CalibrationRecord:
    """A record of a robot of which nothing is known yet beyond its design."""
    return dataclasses.replace(load_calibration(), robot=robot, by=by, made=today, valid_days=VALID_DAYS)


def record_path(folder: pathlib.Path, robot: str) -> pathlib.Path:
    """Where the record of a robot is kept."""
    return folder / f"{to_file_name(_NO_FILE_NAME.sub('_', robot.strip()), 'robot')}.yaml"


def save_calibration(path: pathlib.Path, record: CalibrationRecord) -> None:
    """Write a record; InvalidCalibration when a figure is beyond what a file may hold, OutputError when it cannot be
    written."""
    document = record.to_document()
    calibration_from(document)
    text = yaml.safe_dump(document, sort_keys=False, allow_unicode=True)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"The file {path} cannot be written: {error.strerror or error}.") from None
    write_bytes(path, text.encode("utf-8"))
