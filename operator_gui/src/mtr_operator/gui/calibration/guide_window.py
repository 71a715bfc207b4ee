"""The guided calibration: key's lever, key height and press strength, each kept in the robot's record with its date."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from PyQt5.QtCore import QSize
from PyQt5.QtWidgets import QDialog, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.domain.errors import InvalidCalibration, OperatorError
from mtr_operator.domain.estimation.budget.calibration import CalibrationRecord
from mtr_operator.station.calibration.record_keeper import Change, RecordKeeper
from mtr_operator.station.links.idle_loop import CalibrationRequest
from mtr_operator.station.readiness import RUNNING, ReadinessWord

from ..fitting.breaks import breakable
from ..fitting.place import open_within
from ..fitting.scroller import Scroller
from ..flow import Flow
from ..forms.field import Field
from ..forms.file_field import FileField
from ..sentences import translated
from ..theme.scale import L, M
from ..windows.card import Card
from .height_card import HeightCard
from .lever_card import LeverCard
from .press_card import PressCard

_SIZE = QSize(820, 860)


class GuideWindow(QDialog):
    """Attributes: file: the record in use. robot, by: whose it is, and who measures. lever, heights, press: the steps.
    notice: what became of the last one."""

    def __init__(self, flow: Flow, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(self.tr("Guided calibration"))
        self._flow = flow
        self._keeper = RecordKeeper(flow.store)
        self.file = FileField(self.tr("Calibration record"), self.tr("a new one"),
                              self.tr("What is known of this robot; the uncertainties follow from it."))
        self.robot = Field(self.tr("Robot"), self.tr("Its name or number; the record is kept under it."))
        self.by = Field(self.tr("Measured by"))
        self.by.show_text(flow.store.settings.identity.operator)
        self.lever, self.heights, self.press = LeverCard(), HeightCard(), PressCard()
        self.notice = QLabel()
        self.notice.setWordWrap(True)
        self._lay_out()
        self._connect()
        self._show_record()
        self._learn()
        self.ensurePolished()
        open_within(self, _SIZE)

    def _lay_out(self) -> None:
        record = Card(self.tr("Record"))
        for widget in (self.file, self.robot, self.by):
            record.column.addWidget(widget)
        cards = QVBoxLayout()
        cards.setSpacing(M)
        for card in (record, self.press, self.heights, self.lever):
            cards.addWidget(card)
        cards.addStretch(1)
        close = QPushButton(self.tr("Close"))
        close.clicked.connect(self.reject)
        row = QHBoxLayout()
        row.addWidget(self.notice, 1)
        row.addWidget(close)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(L, L, L, L)
        layout.setSpacing(M)
        layout.addWidget(Scroller(cards), 1)
        layout.addLayout(row)
        self._own_enter()

    def _own_enter(self) -> None:
        """Enter in a field does not order anything."""
        for button in self.findChildren(QPushButton):
            if isinstance(button, QPushButton):
                button.setAutoDefault(False)

    def _connect(self) -> None:
        self.file.changed.connect(self._use)
        self.heights.height_wanted.connect(self._go)
        self.press.press_wanted.connect(self._flow.calibrate)
        for card in (self.lever, self.heights, self.press):
            card.kept.connect(self._keep)
        self._flow.stopped.connect(self.press.stop)
        self._flow.bridge.changed.connect(self._learn)

    def done(self, result: int) -> None:
        """See QDialog; however it is left, what moves is stopped first."""
        self.press.stop()
        if self._flow.model.may_move:
            self._flow.stop()
        super().done(result)

    def _learn(self) -> None:
        model = self._flow.model
        if model.robot is None:
            return
        may_order = model.readiness.word is not ReadinessWord.LOST and model.phase not in RUNNING
        self.lever.learn(model.robot.status)
        self.heights.learn(model.robot.status, may_order)
        self.press.learn(model.robot.status, model.robot.lock_state, may_order)

    def _go(self, height_m: float) -> None:
        self.press.stop()
        self._flow.calibrate(CalibrationRequest(height_m, (), 0.0, 0.0))

    def _use(self) -> None:
        try:
            self._keeper.use(self.file.path)
        except InvalidCalibration as error:
            self.file.show_fault(translated(str(error)))
            return
        self._show_record()

    def _show_record(self) -> None:
        record: CalibrationRecord | None = None
        fault = ""
        try:
            record = self._keeper.record()
        except InvalidCalibration as error:
            fault = translated(str(error))
        self.file.show_path(self._keeper.path)
        self.file.show_fault(fault)
        self.robot.edit.setReadOnly(record is not None)
        if record is not None:
            self.robot.show_text(record.robot)

    def _keep(self, change: Change) -> None:
        robot, by = self.robot.text.strip(), self.by.text.strip()
        missing = self.tr("Enter it before something is kept.")
        self.robot.show_fault("" if robot else missing)
        self.by.show_fault("" if by else missing)
        if not robot or not by:
            self.notice.setText("")
            return
        try:
            path = self._keeper.keep(change, robot, by)
        except OperatorError as error:
            self.notice.setText(translated(str(error)))
            return
        self._show_record()
        self._show_kept(path)

    def _show_kept(self, path: pathlib.Path) -> None:
        self.notice.setText(self.tr("Kept in {path}; the next tests use it.").format(path=breakable(str(path))))
