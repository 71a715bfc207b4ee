"""Learning a Car in a dialog: the person locks and unlocks it as asked, and gets a profile of it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import pathlib

from PyQt5.QtCore import QSize, QTimer, pyqtSignal
from PyQt5.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from mtr_operator.car_link.learn.database_names import DatabaseNames
from mtr_operator.car_link.learn.findings import Findings
from mtr_operator.car_link.learn.learning import Learning
from mtr_operator.car_link.learn.session import DEFAULT_PROMPTS, Stage
from mtr_operator.car_link.learn.words import doubts, unnamed
from mtr_operator.car_link.learn.written_profile import write_profile
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.ports import LockState
from mtr_operator.station.connection import CanChoice

from ..dialogs import ask_database
from ..fitting.breaks import breakable
from ..fitting.place import open_within
from ..fitting.plain_table import plain_table, show_in
from ..fitting.scroller import Scroller
from ..flow import Flow
from ..forms.field import Field
from ..forms.file_field import FileField
from ..sentences import translated
from ..theme.scale import L, M
from .adapter_loan import AdapterLoan
from .candidate_model import CandidateModel

_SIZE = QSize(900, 640)
_PERIOD_MS = 100
_TABLE_HEIGHT = 160


class LearnWindow(QDialog):
    """Attributes: what: what the person is to do now. act: button that begins, and answers. progress: of the prompts.
    note: what comes over the bus, and what went wrong. table: what followed. doubt: why that may be wrong. database:
    which names it. name: of the Car. keep: button that writes the profile.

    Signals: learned(path): a profile was written.
    """

    learned = pyqtSignal(str)

    def __init__(self, flow: Flow, choice: CanChoice, folder: pathlib.Path, parent: QWidget | None = None):
        """choice: the adapter. folder: of the profiles that are learned."""
        super().__init__(parent)
        self.setWindowTitle(self.tr("Learn a Car"))
        self._flow, self._choice, self._folder = flow, choice, folder
        self._loan = AdapterLoan(flow, self)
        self._learning: Learning | None = None
        self._stage = Stage.OPENING
        self._findings: Findings | None = None
        self._names: DatabaseNames | None = None
        self.what, self.note, self.doubt = QLabel(), QLabel(), QLabel()
        for label, role in ((self.what, "large"), (self.note, "soft"), (self.doubt, "soft")):
            label.setWordWrap(True)
            label.setProperty("role", role)
        self.act = QPushButton(self.tr("Begin"))
        self.act.setProperty("role", "primary")
        self.progress = QProgressBar()
        self.progress.setAccessibleName(self.tr("Prompts that are answered"))
        self.progress.setMaximum(DEFAULT_PROMPTS)
        self.table = self._make_table()
        self.name = Field(self.tr("Name of the Car"),
                          self.tr("Letters, digits, - and _; the profile is kept under it."))
        self.database = FileField(self.tr("CAN database of the Car"), self.tr("none: the profile gets one of its own"),
                                  self.tr("Names the message and the signal."), ask=ask_database)
        self.keep = QPushButton(self.tr("Keep the profile"))
        self._timer = QTimer(self)
        self._timer.setInterval(_PERIOD_MS)
        self._lay_out()
        self._connect()
        self._invite()
        self.ensurePolished()
        open_within(self, _SIZE)

    def _make_table(self) -> QTableView:
        table = plain_table(self.tr("What followed the locks"), _TABLE_HEIGHT)
        table.setSelectionMode(QTableView.NoSelection)
        return table

    def _lay_out(self) -> None:
        column = QVBoxLayout()
        column.setSpacing(M)
        for widget in (self.what, self.progress, self.table, self.doubt, self.database, self.name, self.note):
            column.addWidget(widget)
        column.addStretch(1)
        close = QPushButton(self.tr("Close"))
        close.clicked.connect(self.reject)
        row = QHBoxLayout()
        row.addWidget(self.act)
        row.addWidget(self.keep)
        row.addStretch(1)
        row.addWidget(close)
        for button in (self.keep, close):
            button.setAutoDefault(False)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(L, L, L, L)
        layout.setSpacing(M)
        layout.addWidget(Scroller(column), 1)
        layout.addLayout(row)

    def _connect(self) -> None:
        self.act.clicked.connect(self._act)
        self.keep.clicked.connect(self._keep)
        self.database.changed.connect(self._name_findings)
        self.name.changed.connect(lambda: self.keep.setEnabled(bool(self.name.text.strip())))
        self._timer.timeout.connect(self._tick)
        self._loan.taken.connect(self._begin)

    def _invite(self) -> None:
        """Before the first prompt, and again after one that led to nothing."""
        self.what.setText(self.tr("You lock and unlock the Car with its own key {count} times, when you are asked; "
                                  "meanwhile its bus is listened to. Nothing is sent.").format(count=DEFAULT_PROMPTS))
        self.act.setText(self.tr("Begin"))
        self.act.setVisible(True)
        self.act.setEnabled(True)
        for widget in (self.progress, self.table, self.doubt, self.database, self.name, self.keep):
            widget.hide()

    def _act(self) -> None:
        if self._learning is not None:
            self._learning.done()
            self._tick()
            return
        self.act.setEnabled(False)
        self.note.setText(self.tr("The adapter is opened."))
        self._loan.take(self._choice)

    def _begin(self) -> None:
        try:
            self._learning = Learning(functools.partial(self._flow.connecting.opener.listener, self._choice))
        except OperatorError as error:
            self._give_up(str(error))
            return
        self._stage = Stage.OPENING
        self._learning.start()
        self.progress.setValue(0)
        self.progress.show()
        self._timer.start()

    def _tick(self) -> None:
        """Time has passed, or the person has answered."""
        learning = self._learning
        if learning is None:
            return
        try:
            stage = learning.tick()
        except OperatorError as error:
            self._give_up(str(error))
            return
        if stage is Stage.COMPLETE:
            self._finish(learning)
            return
        self._show_stage(learning, stage)

    def _show_stage(self, learning: Learning, stage: Stage) -> None:
        session = learning.session
        self.progress.setValue(session.number - 1)
        self.note.setText(self.tr("{count} frames so far.").format(count=session.recording.count))
        if stage is self._stage:
            return
        self._stage = stage
        is_asked = stage is Stage.ASKED
        self.act.setEnabled(is_asked)
        self.act.setText(self.tr("It is done"))
        question = self.tr("{number} of {count}: lock the Car with its own key.") \
            if session.wanted is LockState.LOCKED else self.tr("{number} of {count}: unlock the Car, all doors.")
        self.what.setText(question.format(number=session.number, count=session.prompts) if is_asked else
                          self.tr("Leave the Car alone for a moment."))
        if is_asked:
            self.act.setFocus()

    def _finish(self, learning: Learning) -> None:
        """All is recorded: look through it in a thread, and show what there is."""
        if self._stage is not Stage.COMPLETE:
            self._stage = Stage.COMPLETE
            self.act.setEnabled(False)
            self.progress.setValue(learning.session.prompts)
            self.what.setText(self.tr("The recording is looked through."))
            learning.close()
            learning.look_through()
        elif learning.found is not None:
            self._let_go()
            self._show_findings(learning.found)

    def _show_findings(self, findings: Findings) -> None:
        self._findings = findings
        try:
            best = findings.proposal
        except OperatorError as error:
            self._give_up(str(error))
            self._show_table(findings)
            return
        self.what.setText(self.tr("The message {id} tells the locks.").format(id=f"{best.id[0]:03X}"))
        self._name_findings()
        self.act.hide()
        self.database.show()
        self.name.show()
        self.keep.show()
        self.keep.setEnabled(bool(self.name.text.strip()))
        self.name.edit.setFocus()

    def _name_findings(self) -> None:
        """By the database that is chosen; a file that is none is said at its line."""
        self._names, fault = None, ""
        try:
            self._names = None if self.database.path is None else DatabaseNames(self.database.path)
        except OperatorError as error:
            fault = translated(str(error))
        self.database.show_fault(fault)
        if self._findings is not None:
            told = (*doubts(self._findings), unnamed(self._findings, self._names))
            self.doubt.setText(" ".join(translated(each) for each in told if each))
            self.doubt.setVisible(bool(self.doubt.text()))
            self._show_table(self._findings)

    def _show_table(self, findings: Findings) -> None:
        show_in(self.table, CandidateModel(findings, self.table, self._names))
        self.table.setVisible(bool(findings.candidates))
        self.progress.hide()

    def _keep(self) -> None:
        if self._findings is None:
            return
        path = self._folder / f"{self.name.text.strip()}.yaml"
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            write_profile(path, self._findings, self._names)
        except (OperatorError, OSError) as error:
            self.name.show_fault(translated(str(error)))
            return
        self.note.setText(self.tr("Kept in {path}.").format(path=breakable(str(path))))
        self.learned.emit(str(path))
        self.accept()

    def _give_up(self, sentence: str) -> None:
        self._let_go()
        self._invite()
        self.note.setText(translated(sentence))

    def _let_go(self) -> None:
        self._timer.stop()
        learning, self._learning = self._learning, None
        if learning is not None:
            learning.close()
        self._loan.give_back()

    def done(self, result: int) -> None:
        """See QDialog; the adapter goes back."""
        self._let_go()
        super().done(result)
