"""Files that go with the parameters: limits of the test, and the calibration record of the robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QVBoxLayout, QWidget

from mtr_operator.domain.errors import InvalidCalibration, InvalidLimits
from mtr_operator.domain.estimation.budget.calibration import CalibrationRecord
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.verdict.limits import Limits
from mtr_operator.domain.verdict.suitability import check_before_start
from mtr_operator.storage.given_files import GivenPaths, load_calibration, load_limits

from ..sentences import translated
from ..theme.scale import S
from .file_field import FileField


class GivenForm(QWidget):
    """Attributes: limits, calibration: fields of the files.

    Signals: changed: another file was chosen, or none.
    """

    changed = pyqtSignal()

    def __init__(self, scenario: AnyScenario, parent: QWidget | None = None):
        super().__init__(parent)
        self._scenario = scenario
        self._limits: Limits | None = None
        self._record: CalibrationRecord | None = None
        self._faults = {"limits": "", "calibration": ""}
        self._unsuitable = ""
        self.limits = FileField(self.tr("Limits file"), self.tr("none: no verdict"),
                                self.tr("What the distances have to be; the lines are judged by it."))
        self.calibration = FileField(self.tr("Calibration record"), self.tr("that of the design"),
                                     self.tr("What is known of this robot; the uncertainties follow from it."))
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(S)
        for field in (self.limits, self.calibration):
            layout.addWidget(field)
            field.changed.connect(self._read)

    @property
    def paths(self) -> GivenPaths:
        """The chosen files."""
        return GivenPaths(self.limits.path, self.calibration.path)

    def cautions(self, parameters: ScenarioParameters | None) -> tuple[str, ...]:
        """Sentences on a record that is not of today's robot any more, and on parameters that it speaks against."""
        record = self._record
        return () if record is None else record.cautions(parameters, datetime.date.today())

    @property
    def limit_count(self) -> int:
        """How many limits are loaded."""
        return 0 if self._limits is None else len(self._limits.requirements)

    @property
    def limits_problem(self) -> str:
        """Why they cannot be used, as judged last; empty when they can."""
        return self._faults["limits"] or self._unsuitable

    def show_paths(self, paths: GivenPaths) -> None:
        """Show files, and read them."""
        self.limits.show_path(paths.limits)
        self.calibration.show_path(paths.calibration)
        self._read()

    def judge(self, parameters: ScenarioParameters | None) -> bool:
        """True when the files are good and the limits suit the parameters; else a field says why not."""
        unsuitable = ""
        if parameters is not None and self._limits is not None:
            try:
                check_before_start(self._limits, self._scenario, parameters)
            except InvalidLimits as error:
                unsuitable = str(error)
        self.limits.show_fault(translated(self._faults["limits"] or unsuitable))
        self.calibration.show_fault(translated(self._faults["calibration"]))
        self._unsuitable = unsuitable
        return not (unsuitable or any(self._faults.values()))

    def _read(self) -> None:
        paths = self.paths
        self._limits = self._record = None
        self._faults = {"limits": "", "calibration": ""}
        try:
            self._limits = None if paths.limits is None else load_limits(paths.limits)
        except InvalidLimits as error:
            self._faults["limits"] = str(error)
        try:
            self._record = None if paths.calibration is None else load_calibration(paths.calibration)
        except InvalidCalibration as error:
            self._faults["calibration"] = str(error)
        self.changed.emit()
