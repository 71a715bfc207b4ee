"""The tests of before: searched, opened, continued, repeated, compared."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import TYPE_CHECKING, Any, Callable, Sequence

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import (
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from mtr_operator.history.bundles import is_bundle
from mtr_operator.history.chosen import brought, compared, replayed, side_of, spread_of_chosen
from mtr_operator.history.entry import TestEntry
from mtr_operator.history.index import Index, cache_path
from mtr_operator.history.search import problems_of, repetitions

from ..dialogs import ask_bundle
from ..evidence.bundle_check import BundleCheck, check_text
from ..fitting.breaks import breakable
from ..fitting.plain_table import plain_table
from ..fitting.prose import Prose
from ..fitting.rows import choose_rows, chosen_rows
from ..fitting.scroller import Scroller
from ..sentences import translated
from ..theme.scale import L, M, S
from ..threads.task import Task, Work
from .history_filters import HistoryFilters
from .history_model import HistoryModel
from .history_reader import HistoryReader

if TYPE_CHECKING:
    from mtr_operator.evidence.verification import Verification
    from mtr_operator.history.spread import TestSpread

_TABLE_HEIGHT = 120
_PROBLEMS_SHOWN = 2


class HistoryScreen(QWidget):
    """Attributes: search: text field. filters: it, and boxes. table. notice: how many there are, and what is wrong.

    open, repeat, compare, spread, file, verify, anew, back: buttons.

    Signals: open_wanted(path), repeat_wanted(side), compare_wanted(comparison), spread_wanted(TestSpread),
        replayed(name, ReplayedTest), file_wanted, closed.
    """

    open_wanted = pyqtSignal(object)
    repeat_wanted = pyqtSignal(object)
    compare_wanted = pyqtSignal(object)
    spread_wanted = pyqtSignal(object)
    replayed = pyqtSignal(object, object)
    file_wanted = pyqtSignal()
    closed = pyqtSignal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("page")
        self._index: Index | None = None
        self._folders: tuple[pathlib.Path, ...] = ()
        self._reader: HistoryReader | None = None
        self._check: BundleCheck | None = None
        self._tasks: dict[Task, tuple[QPushButton, Callable[[Any], None]]] = {}
        self._entries: Sequence[TestEntry] = ()
        self._summary = ""
        self._model = HistoryModel(self)
        self.filters = HistoryFilters()
        self.filters.changed.connect(self._show)
        self.search = self.filters.search
        self.table = self._make_table()
        self.notice = Prose()
        self.open = self._button(self.tr("Open"), self._open)
        self.open.setProperty("role", "primary")
        self.repeat = self._button(self.tr("Repeat"), self._repeat)
        self.repeat.setToolTip(self.tr("A new test with the same parameters, car and key"))
        self.compare = self._button(self.tr("Compare two"), self._compare)
        self.spread = self._button(self.tr("Spread"), self._compute_spread)
        self.spread.setToolTip(self.tr("Mean and standard deviation of each distance: of the tests chosen, or of all "
                                       "tests of the car and key of one test with its parameters"))
        self.file = self._button(self.tr("Open a file"), self.file_wanted.emit)
        self.verify = self._button(self.tr("Verify a bundle"), self._ask_bundle)
        self.verify.setToolTip(self.tr("Whether a bundle of evidence is as it was signed, by whom and when"))
        self.anew = self._button(self.tr("Compute anew"), self._replay)
        self.anew.setToolTip(self.tr("What would change in this test with the car profile as it is now, from its "
                                     "recorded log and poses"))
        self.back = self._button(self.tr("Back"), self.closed.emit)
        self._lay_out()
        self._show_choice()

    def _make_table(self) -> QTableView:
        table = plain_table(self.tr("Tests; choose one to open it, or two to compare them"), _TABLE_HEIGHT)
        table.setModel(self._model)
        table.setSelectionMode(QTableView.ExtendedSelection)
        # Of ten thousand rows only those in sight are measured.
        table.horizontalHeader().setResizeContentsPrecision(0)
        table.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        table.selectionModel().selectionChanged.connect(lambda *_: self._show_choice())
        table.doubleClicked.connect(lambda _: self._open())
        return table

    @staticmethod
    def _button(text: str, act: Callable[[], None]) -> QPushButton:
        button = QPushButton(text)
        button.clicked.connect(lambda _checked: act())
        return button

    def _lay_out(self) -> None:
        title = QLabel(self.tr("Tests so far"))
        title.setProperty("role", "heading")
        buttons, top = QHBoxLayout(), QHBoxLayout()
        top.addWidget(title, 1)
        for widget in (self.spread, self.anew, self.verify):
            top.addWidget(widget)
        buttons.setSpacing(S)
        for widget in (self.back, self.file, self.repeat, self.compare, self.open):
            buttons.addWidget(widget, 1)
        column = QVBoxLayout()
        column.setSpacing(S)
        column.addLayout(top)
        column.addWidget(self.filters)
        column.addWidget(self.table, 1)
        column.addWidget(self.notice)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(L, M, L, M)
        layout.setSpacing(S)
        layout.addWidget(Scroller(column), 1)
        layout.addLayout(buttons)

    def read(self, folders: Sequence[pathlib.Path]) -> None:
        """Bring the list up to date; what was known before is shown meanwhile."""
        if self._reader is not None and self._reader.isRunning():
            return
        if self._index is None or tuple(folders) != self._folders:
            self._folders = tuple(folders)
            self._index = Index(self._folders, cache_path(self._folders))
        self._summary = ""
        self.notice.setText(self.tr("The folders are being read."))
        # No child of the screen, and no lambda: it may outlive it when the window is made anew.
        self._reader = HistoryReader(self._index)
        self._reader.told.connect(self._learn)
        self._reader.done.connect(self._learn_all)
        self._reader.start()

    @property
    def chosen(self) -> list[TestEntry]:
        """Tests whose rows are chosen, the oldest first."""
        return [self._model.entries[row] for row in reversed(chosen_rows(self.table))]

    @property
    def shown(self) -> Sequence[TestEntry]:
        """Tests in the table."""
        return [entry for entry in self._model.entries if not entry.problem]

    def say(self, sentence: str) -> None:
        """Tell the Operator something."""
        self.notice.setText(breakable(sentence))

    def _ask_bundle(self) -> None:
        path = ask_bundle(self, self.tr("Bundle of evidence"), self._folders[-1] if self._folders else pathlib.Path())
        if path is not None:
            self.verify_bundle(path)

    def verify_bundle(self, path: pathlib.Path) -> None:
        """Say whether a bundle is intact."""
        self.verify.setEnabled(False)
        self.say(self.tr("{name} is being verified.").format(name=path.name))
        # No child of the screen, and no lambda: it may outlive it when the window is made anew.
        self._check = BundleCheck(path)
        self._check.checked.connect(self._show_check)
        self._check.start()

    def _show_check(self, path: pathlib.Path, found: Verification) -> None:
        self.verify.setEnabled(True)
        self.say(check_text(path, found))

    def _begin(self, button: QPushButton, sentence: str, work: Work, end: Callable[[Any], None]) -> None:
        """Do something with the tests that are chosen; end: takes what came out."""
        # No child of the screen, and no lambda: it may outlive it when the window is made anew.
        task = Task(work)
        self._tasks[task] = button, end
        task.done.connect(self._finish)
        task.refused.connect(self._refuse)
        self._show_choice()
        self.say(sentence)
        task.start()

    # A thread that has told its result may not have ended yet; nobody waits for it.

    def _finish(self, task: Task, found: Any) -> None:
        _, end = self._tasks.pop(task)
        self._show_choice()
        end(found)

    def _refuse(self, task: Task, text: str) -> None:
        self._tasks.pop(task)
        self._show_choice()
        self.say(translated(text))

    def _learn(self, entries: list[TestEntry]) -> None:
        self._entries = entries
        self.filters.offer(entries)
        self._show()

    def _learn_all(self, entries: list[TestEntry]) -> None:
        self._learn(entries)
        problems = problems_of(entries)
        counted = self.tr("{count} tests, {shown} of them shown.").format(count=len(entries) - len(problems),
                                                                        shown=len(self.shown))
        stored = {entry.store for entry in entries if entry.store}
        if stored:
            told = self.tr("In the store {where} alone: {count}; what is opened is copied from there.")
            counted += " " + told.format(where=", ".join(stored), count=sum(1 for entry in entries if entry.store))
        more = len(problems) - _PROBLEMS_SHOWN
        tail = [self.tr("{count} more files cannot be read.").format(count=more)] if more > 0 else []
        self._summary = "\n".join([counted, *map(translated, problems[:_PROBLEMS_SHOWN]), *tail])
        self.say(self._summary)
        self.notice.setToolTip("\n".join(map(translated, problems)))

    def _show(self) -> None:
        before = set(map(_mark, self.chosen))
        self._model.show_entries(self.filters.sifted(self._entries))
        # What grows while it is read must not take a choice away.
        if before:
            choose_rows(self.table, (row for row, entry in enumerate(self._model.entries) if _mark(entry) in before))
        self._show_choice()

    def _show_choice(self) -> None:
        chosen = self.chosen
        is_good = not any(entry.problem for entry in chosen)
        is_bundle_alone = len(chosen) == 1 and is_bundle(chosen[0].file)
        self.open.setEnabled(is_good and len(chosen) == 1 and not is_bundle_alone)
        self.anew.setEnabled(self.open.isEnabled())
        self.repeat.setEnabled(is_good and len(chosen) == 1)
        self.compare.setEnabled(is_good and len(chosen) == 2)
        self.spread.setEnabled(is_good and bool(chosen))
        for button, _ in self._tasks.values():
            button.setEnabled(False)
        is_unfinished = len(chosen) == 1 and is_good and not chosen[0].is_complete
        self.open.setText(self.tr("Continue") if is_unfinished else self.tr("Open"))
        if not is_good and len(chosen) == 1:
            self.say(translated(chosen[0].problem))
        elif is_bundle_alone:
            self.say(self.tr("This test is in a signed bundle: it can be repeated and compared. Unpack the bundle into "
                             "a folder of its own to open it."))
        elif self._summary:
            self.say(self._summary)

    def _open(self) -> None:
        # A row is opened by two clicks, too.
        if self.open.isEnabled():
            entry, folder = self.chosen[0], self._folders[0]
            self._begin(self.open, self._is_read(1), lambda _: brought(entry, folder), self.open_wanted.emit)

    def _repeat(self) -> None:
        entry = self.chosen[0]
        self._begin(self.repeat, self._is_read(1), lambda _: side_of(entry), self.repeat_wanted.emit)

    def _compare(self) -> None:
        first, second = self.chosen
        self._begin(self.compare, self._is_read(2), lambda _: compared(first, second), self.compare_wanted.emit)

    def _replay(self) -> None:
        entry = self.chosen[0]
        self._begin(self.anew, self.tr("{name} is being computed anew.").format(name=entry.name),
                    lambda _: replayed(entry), lambda found: self.replayed.emit(entry.name, found))

    def _compute_spread(self) -> None:
        chosen = self.chosen
        alike = chosen[0] if len(chosen) == 1 else None
        tests = chosen if alike is None else repetitions(self._entries, alike)
        if len(tests) < 2:
            self._show_spread(None)
        else:
            self._begin(self.spread, self._is_read(len(tests)),
                        lambda is_cancelled: spread_of_chosen(tests, alike, is_cancelled), self._show_spread)

    def _show_spread(self, found: TestSpread | None) -> None:
        if found is None:
            self.say(self.tr("No other test has the parameters, the car and the key of this one."))
        else:
            self.spread_wanted.emit(found)

    def _is_read(self, count: int) -> str:
        return self.tr("{count} tests are being read.").format(count=count)


def _mark(entry: TestEntry) -> str:
    """The same for a test in each copy of it, and in each look."""
    return entry.test_id or entry.path
