"""The protocol screen: areas and points around the Car, the table beside them, and files of both."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from typing import Callable

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QPushButton, QTableView, QVBoxLayout, QWidget

from mtr_operator.domain.results.picture import Picture
from mtr_operator.domain.results.progress import Progress
from mtr_operator.report.protocol_rows import date_text
from mtr_operator.station.checks.checklist import hindrances
from mtr_operator.station.events import Outcome

from ..fitting.plain_table import plain_table, show_in
from ..fitting.prose import Prose
from ..fitting.scroller import Scroller
from ..flow import Flow
from ..forms.hold_button import HoldButton
from ..names import scenario_title
from ..pictures.picture_panel import PicturePanel
from ..pictures.protocol_picture import Protocol, ProtocolPicture
from ..report_writer import BUNDLE, CSV, PDF, PNG, SVG
from ..sentences import translated
from ..theme.appearance import Appearance
from ..theme.scale import M, S
from ..threads.task import Task
from ..verdict_text import verdict_text
from .budget_model import BudgetModel
from .protocol_files import ProtocolFiles, Shown
from .results_model import ResultsModel

_SIDE_WIDTH = 600
_TABLE_HEIGHT, _BUDGET_HEIGHT = 180, 140
_NOTICE_LINES = 3
_CLICK_PX = 18.0


class ProtocolScreen(QWidget):
    """Attributes: protocol: what is shown. panel: the picture. table: the results. budget: of the row chosen.
    notice: what was saved.

    save, save_pdf, save_svg, bundle, show_folder, annotate, again, done: buttons; again is held, for it moves the
    robot.

    Signals: closed: the Operator is done with it.
    """

    closed = pyqtSignal()

    def __init__(self, flow: Flow, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("page")
        self._flow = flow
        self._is_shown = False
        self._told = ""
        self._files = ProtocolFiles(flow, self)
        self._files.saving.connect(self._set_saving)
        self._files.told.connect(self._show_notice)
        self.panel = PicturePanel(appearance)
        self.panel.view.clicked.connect(self._choose_point)
        self.title, self.date, self.notice = QLabel(), QLabel(), Prose()
        self.title.setProperty("role", "heading")
        self.date.setProperty("role", "soft")
        self.table = plain_table(self.tr("Results; choose a row to see its points, or several to measure them again"),
                                 _TABLE_HEIGHT)
        self.table.setSelectionMode(QTableView.ExtendedSelection)
        self.budget = plain_table(self.tr("What the uncertainty of the chosen row is made of"), _BUDGET_HEIGHT)
        self.budget.setSelectionMode(QTableView.NoSelection)
        self.budget.hide()
        self.save = self._button(self.tr("Save"), "primary", lambda: self._files.write((CSV, PNG)))
        self.save.setToolTip(self.tr("Save as CSV and PNG"))
        self.save_pdf = self._button(self.tr("Save PDF"), "", lambda: self._files.write((PDF,)))
        self.save_svg = self._button(self.tr("Save SVG"), "", lambda: self._files.write((SVG,)))
        self.show_folder = self._button(self.tr("Show folder"), "", self._files.open_folder)
        self._files.written.connect(lambda: self.show_folder.setEnabled(True))
        self.again = HoldButton(self.tr("Hold to measure again"))
        self.again.held.connect(self._measure_again)
        self.annotate = self._button(self.tr("Notes and photos"), "", self._files.annotate)
        self.bundle = self._button(self.tr("Save evidence bundle"), "",
                                   lambda: self._files.write((CSV, PNG, PDF, BUNDLE)))
        self.bundle.setToolTip(self.tr("One signed file with results, recording, profile, software versions and "
                                       "journal"))
        self.done = self._button(self.tr("New test"), "", self.closed.emit)
        self._lay_out()

    @property
    def protocol(self) -> Protocol:
        """What is shown."""
        return self._files.shown.picture.protocol

    @property
    def is_pictured(self) -> bool:
        """True when what was measured is shown, and not only the Car."""
        return self._files.shown.picture.is_complete

    @staticmethod
    def _button(text: str, role: str, act: Callable[[], None]) -> QPushButton:
        button = QPushButton(text)
        button.setProperty("role", role)
        button.clicked.connect(lambda _checked: act())
        return button

    def _lay_out(self) -> None:
        side = QVBoxLayout()
        side.setContentsMargins(0, 0, 0, 0)
        side.setSpacing(S)
        side.addWidget(self.title)
        side.addWidget(self.date)
        side.addWidget(self.table, 3)
        side.addWidget(self.budget, 2)
        side.addWidget(self.again)
        # In few rows: on a small laptop the results need the height.
        for buttons in ((self.annotate, self.show_folder), (self.save, self.save_pdf, self.save_svg),
                        (self.bundle, self.done)):
            row = QHBoxLayout()
            row.setSpacing(S)
            for button in buttons:
                row.addWidget(button, 1)
            side.addLayout(row)
        holder = Scroller(side)
        holder.setMaximumWidth(_SIDE_WIDTH)
        columns = QHBoxLayout()
        columns.setSpacing(M)
        columns.addWidget(self.panel, 2)
        columns.addWidget(holder, 3)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(M, M, M, M)
        layout.setSpacing(M)
        layout.addLayout(columns, 1)
        # Below all, with its room from the start: a sentence that comes must not move a button under the mouse.
        self.notice.setAlignment(Qt.AlignmentFlag.AlignTop)
        layout.addWidget(self.notice)

    def show_test(self) -> None:
        """Show the test at hand."""
        self.notice.setMinimumHeight(_NOTICE_LINES * self.notice.fontMetrics().lineSpacing())
        model = self._flow.model
        test = model.current_test
        progress: Progress = dataclasses.replace(test.progress, results=list(model.results))
        protocol = Protocol(test.scenario, test.parameters, progress)
        self._files.show(Shown(ProtocolPicture(protocol), test))
        self._compute_picture()
        self._is_shown = True
        self.title.setText(self.tr("{scenario} protocol").format(scenario=scenario_title(test.scenario)))
        self.date.setText(date_text(str(progress.session.get("started", ""))))
        show_in(self.table, ResultsModel(protocol, self))
        self.table.selectionModel().currentRowChanged.connect(lambda index, _: self._mark(index.row()))
        self.table.selectionModel().selectionChanged.connect(lambda *_: self.show_model())
        self._show_budget(-1)
        self._show_notice(self.tr("Not saved as CSV and PNG yet."))
        self.show_folder.setEnabled(False)
        self.save.setFocus()
        self.show_model()
        if model.outcome is Outcome.COMPLETE:
            # Nobody has to think of it.
            self._files.write((CSV, PNG))

    def _compute_picture(self) -> None:
        """In a thread: that of many zones takes seconds, in which a window that stands could stop no robot."""
        shown = self._files.shown.picture
        self.panel.legend.show_sets(())
        self.panel.view.show_layers(shown.layers)
        task = Task(lambda _: (shown, shown.protocol.computed()))
        task.done.connect(self._take_picture)
        task.refused.connect(self._say_no_picture)
        task.start()

    def _say_no_picture(self, _: Task, text: str) -> None:
        self._show_notice(translated(text))

    def _take_picture(self, _: Task, computed: tuple[ProtocolPicture, Picture]) -> None:
        shown, picture = computed
        if shown is not self._files.shown.picture:
            return
        shown.take(picture)
        self.panel.legend.show_sets(picture.point_sets)
        self.panel.view.show_layers(shown.layers)
        self._mark(self.table.currentIndex().row())

    def show_model(self) -> None:
        """Something of robot, Car or test is another one."""
        readiness = self._flow.model.readiness
        can_start = readiness.can_start and not hindrances(self._flow.model.checklist)
        self.again.setEnabled(can_start and bool(self._chosen_lines()))

    def _chosen_lines(self) -> list[int]:
        """Numbers of the lines whose rows are chosen."""
        selection = self.table.selectionModel()
        rows = [] if selection is None or not self._is_shown else sorted(
            index.row() for index in selection.selectedRows())
        return [self.protocol.progress.results[row].number for row in rows]

    def _measure_again(self) -> None:
        self._flow.measure_again(self._chosen_lines())

    def _summary(self) -> str:
        judgement = self.protocol.assessment.judgement
        verdict = "" if judgement is None else self.tr("Verdict: {verdict}.").format(
            verdict=verdict_text(judgement)) + " "
        return verdict + self._counts()

    def _counts(self) -> str:
        results = self.protocol.progress.results
        invalid = sum(1 for result in results if result.invalid_count)
        if invalid:
            return self.tr("{count} lines, {invalid} of them invalid.").format(count=len(results), invalid=invalid)
        return self.tr("{count} lines.").format(count=len(results))

    def _mark(self, row: int) -> None:
        picture = self._files.shown.picture
        picture.points.chosen = picture.points_of(row) if row >= 0 else ()
        self.panel.view.refresh()
        self._show_budget(row)
        why = self.protocol.reason_of(row) if row >= 0 else ""
        self.notice.setText(f"{self._summary()} {translated(why) or self._told}")

    def _show_budget(self, row: int) -> None:
        protocol = self.protocol
        line = protocol.progress.results[row].number if row >= 0 else None
        budget = BudgetModel(protocol.assessment, line, self.budget)
        show_in(self.budget, budget)
        self.budget.setVisible(budget.rowCount() > 0)

    def _choose_point(self, x: float, y: float) -> None:
        """Select the row of the point that was clicked."""
        row = self._files.shown.picture.nearest(x, y, _CLICK_PX / self.panel.view.viewport.px_per_m)
        if row is not None:
            self.table.selectRow(row)

    def _set_saving(self, is_saving: bool) -> None:
        for button in (self.save, self.save_pdf, self.save_svg, self.annotate, self.bundle):
            button.setEnabled(not is_saving)

    def _show_notice(self, sentence: str) -> None:
        self._told = sentence
        self.notice.setText(f"{self._summary()} {sentence}")
        self.notice.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
