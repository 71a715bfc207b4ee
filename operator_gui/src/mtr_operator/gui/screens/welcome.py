"""The first screen: a new test, one to go on with, or calibration."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.station.test import Test

from ..fitting.scroller import Scroller
from ..names import scenario_title
from ..theme.scale import XL, L, M, S
from .tile import Tile

_WIDTH = 620


class WelcomeScreen(QWidget):
    """Signals: new_test, history, area, calibrate; go_on, dismiss: what to do with the unfinished test."""

    new_test = pyqtSignal()
    history = pyqtSignal()
    area = pyqtSignal()
    calibrate = pyqtSignal()
    go_on = pyqtSignal()
    dismiss = pyqtSignal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("page")
        title = QLabel(self.tr("What would you like to do?"))
        title.setProperty("role", "title")
        self.new = Tile(self.tr("New test"), self.tr("Choose scenario and parameters, and let the robot measure."))
        self.open = Tile(self.tr("Tests so far"), self.tr("Open, continue, repeat or compare tests of before."))
        self.border = Tile(self.tr("Test area"), self.tr("Draw the area that the robot does not leave; a real robot "
                                                          "needs it before it maps the Car."))
        self.calibration = Tile(self.tr("Calibrate"), self.tr("Try lift and buttons of the robot."))
        for tile, signal in ((self.new, self.new_test), (self.open, self.history), (self.border, self.area),
                             (self.calibration, self.calibrate)):
            tile.clicked.connect(signal)
        self.offer = self._make_offer()
        column = QVBoxLayout()
        column.setSpacing(M)
        column.addStretch(2)
        column.addWidget(title)
        column.addSpacing(S)
        for widget in (self.offer, self.new, self.open, self.border, self.calibration):
            widget.setFixedWidth(_WIDTH)
            column.addWidget(widget)
        column.addStretch(3)
        row = QHBoxLayout()
        row.addStretch(1)
        row.addLayout(column)
        row.addStretch(1)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(XL, L, XL, L)
        layout.addWidget(Scroller(row))

    def offer_unfinished(self, test: Test | None) -> None:
        """Offer to go on with a test that the last start has not finished; None offers nothing."""
        self.offer.setVisible(test is not None)
        if test is not None:
            self._notice.setText(self.tr("The {scenario} test of {moment} is not finished: {done} of {total} lines are "
                                       "measured.").format(
                scenario=scenario_title(test.scenario),
                moment=str(test.progress.session.get("started", "")).replace("T", " ")[:16],
                done=len(test.progress.results), total=test.line_count))

    def take_focus(self) -> None:
        """What is likely to be wanted gets the focus."""
        (self.new if self.offer.isHidden() else self._first).setFocus()

    def _make_offer(self) -> QWidget:
        offer = QWidget()
        self._notice = QLabel()
        self._notice.setWordWrap(True)
        self._notice.setProperty("role", "notice")
        self._first = QPushButton(self.tr("Go on with it"))
        self._first.setProperty("role", "primary")
        self._first.clicked.connect(self.go_on)
        dismiss = QPushButton(self.tr("Not now"))
        dismiss.clicked.connect(self.dismiss)
        row = QHBoxLayout()
        row.setSpacing(M)
        row.addWidget(self._first)
        row.addWidget(dismiss)
        row.addStretch(1)
        column = QVBoxLayout(offer)
        column.setContentsMargins(0, 0, 0, M)
        column.setSpacing(S)
        column.addWidget(self._notice)
        column.addLayout(row)
        column.setAlignment(Qt.AlignmentFlag.AlignTop)
        return offer
