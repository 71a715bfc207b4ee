"""The settings window: folders, theme, language; the connection is shown, the CAN adapter can be changed."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import pathlib
from typing import Any, Callable

from PyQt5.QtCore import QSize
from PyQt5.QtWidgets import QDialog, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.station.readiness import RUNNING

from ..dialogs import ask_folder, confirm
from ..fitting.place import open_within
from ..fitting.scroller import Scroller
from ..flow import Flow
from ..forms.can_form import CanForm
from ..forms.field import Field
from ..learn.offer import LearnOffer
from ..sentences import translated
from ..theme.appearance import Appearance
from ..theme.scale import L, M, S
from .appearance_form import AppearanceForm
from .card import Card
from .service_card import ServiceCard

_WIDTH = 900


class SettingsWindow(QDialog):
    """Attributes: results, progress: folders. host, subscriber_port, publisher_port: read-only.

    looks: theme, language, sounds, speech. service: service mode of the robot. can, use_can: the adapter. message: what
    became of it.
    """

    def __init__(self, flow: Flow, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(self.tr("Settings"))
        self._flow = flow
        settings, robot = flow.store.settings, flow.connecting.connection.robot
        self.results = self._read_only(self.tr("Results"), str(settings.result_folder))
        self.progress = self._read_only(self.tr("Progress of tests"), str(settings.progress_folder))
        self.host = self._read_only(self.tr("IP address"), robot.host)
        self.subscriber_port = self._read_only(self.tr("Subscriber port"), str(robot.subscriber_port))
        self.publisher_port = self._read_only(self.tr("Publisher port"), str(robot.publisher_port))
        self.looks = AppearanceForm(flow, appearance)
        self.service = ServiceCard(flow)
        self.can = CanForm()
        self.can.show_choice(flow.connecting.connection.can)
        self._can_in_use = self.can.choice
        self._is_asked = False
        self.use_can = QPushButton(self.tr("Use this adapter"))
        self.message = QLabel()
        self.message.setWordWrap(True)
        self.message.setProperty("role", "soft")
        self._lay_out()
        LearnOffer(flow, self.can, self)
        self.looks.changed.connect(self._show_problem)
        self.use_can.clicked.connect(self._change_can)
        flow.connecting.can_opened.connect(self._show_can_in_use)
        flow.connecting.can_refused.connect(self._show_can_refused)
        self._is_changing = False
        flow.bridge.changed.connect(self._suit_test)
        self._suit_test()
        self.ensurePolished()
        open_within(self, self.sizeHint().expandedTo(QSize(_WIDTH, 0)))

    @staticmethod
    def _read_only(title: str, text: str) -> Field:
        field = Field(title)
        field.edit.setText(text)
        field.edit.setReadOnly(True)
        field.note.hide()
        return field

    def _lay_out(self) -> None:
        close = QPushButton(self.tr("Close"))
        close.setDefault(True)
        close.clicked.connect(self.accept)
        row = QHBoxLayout()
        row.addWidget(self.message, 1)
        row.addWidget(close)
        cards = QHBoxLayout()
        cards.setSpacing(M)
        left = QVBoxLayout()
        left.setSpacing(M)
        left.addWidget(self._own_card())
        left.addWidget(self.service)
        left.addStretch(1)
        cards.addLayout(left, 1)
        cards.addWidget(self._connection_card(), 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(L, L, L, L)
        layout.setSpacing(M)
        layout.addWidget(Scroller(cards), 1)
        layout.addLayout(row)

    def _own_card(self) -> Card:
        card = Card(self.tr("Folders"))
        for field, choose in ((self.results, self.choose_results), (self.progress, self.choose_progress)):
            card.column.addLayout(self._folder_row(field, choose))
        card.add_heading(self.tr("Appearance"))
        card.column.addWidget(self.looks)
        return card

    def _connection_card(self) -> Card:
        card = Card(self.tr("Robot"))
        card.column.addWidget(self.host)
        ports = QHBoxLayout()
        ports.setSpacing(M)
        ports.addWidget(self.subscriber_port)
        ports.addWidget(self.publisher_port)
        card.column.addLayout(ports)
        card.add_heading(self.tr("Car"))
        card.column.addWidget(self.can)
        card.column.addWidget(self.use_can)
        card.column.addStretch(1)
        return card

    def _folder_row(self, field: Field, choose: Callable[[], None]) -> QHBoxLayout:
        button = QPushButton(self.tr("Change"))
        button.setAccessibleName(self.tr("Change the folder: {what}").format(what=field.label.text()))
        button.clicked.connect(choose)
        row = QHBoxLayout()
        row.setSpacing(S)
        row.addWidget(field, 1)
        column = QVBoxLayout()
        column.addStretch(1)
        column.addWidget(button)
        row.addLayout(column)
        return row

    def choose_results(self) -> None:
        """Ask for another folder of the results."""
        folder = ask_folder(self, self.tr("Folder for results"), pathlib.Path(self.results.text))
        if folder is not None:
            self.results.edit.setText(str(folder))
            self._change(result_folder=folder)

    def choose_progress(self) -> None:
        """Ask for another folder of the progress."""
        folder = ask_folder(self, self.tr("Folder for the progress of tests"), pathlib.Path(self.progress.text))
        if folder is not None:
            self.progress.edit.setText(str(folder))
            self._change(progress_folder=folder)

    def _suit_test(self) -> None:
        """While a test runs the adapter stays as it is; also when it has begun, or paused, since this was opened."""
        is_free = self._flow.model.phase not in RUNNING
        self.use_can.setEnabled(is_free and not self._is_changing)
        self.can.allow_learning(is_free)

    def _change_can(self) -> None:
        self._is_changing = True
        self._suit_test()
        self._flow.connecting.use_can(self.can.choice)

    def _show_can(self, sentence: str) -> None:
        self._is_changing = False
        self._suit_test()
        self.message.setText(sentence)

    def _show_can_in_use(self) -> None:
        self._can_in_use = self.can.choice
        self._show_can(self.tr("The CAN adapter is in use."))

    def _show_can_refused(self, text: str, bus: str) -> None:
        self._show_can(translated(text))
        if bus:
            self.can.show_fault(translated(text), bus)

    def done(self, result: int) -> None:
        """See QDialog; an adapter that was chosen and is not in use is asked about first."""
        if self._is_asked:
            return
        if self.use_can.isEnabled() and self.can.choice != self._can_in_use and self._is_can_wanted():
            self._change_can()
            return
        super().done(result)

    def _is_can_wanted(self) -> bool:
        question = self.tr("The CAN adapter that you have chosen is not in use yet. Use it?")
        self._is_asked = True
        try:
            return confirm(self, self.windowTitle(), question, (self.tr("Use it"), self.tr("Leave it as it was")))
        finally:
            self._is_asked = False

    def _change(self, **changes: Any) -> None:
        self._flow.store.change(dataclasses.replace(self._flow.store.settings, **changes))
        self._show_problem()

    def _show_problem(self) -> None:
        self.message.setText(self._flow.store.problem)
