"""The tests of before: searched, opened, continued, repeated, compared."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import TYPE_CHECKING, Callable, Sequence

from PyQt5.QtCore import QItemSelection, QItemSelectionModel, pyqtSignal
from PyQt5.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from mtr_operator.domain.errors import OperatorError
from mtr_operator.history.bundles import is_bundle
from mtr_operator.history.comparison import compare
from mtr_operator.history.entry import TestEntry
from mtr_operator.history.index import Index, cache_path
from mtr_operator.history.line_pairs import open_side
from mtr_operator.history.search import matching, problems_of, unreadable, values_of

from ..dialogs import ask_bundle
from ..evidence.bundle_check import BundleCheck, check_text
from ..fitting.breaks import breakable
from ..fitting.plain_table import plain_table
from ..fitting.scroller import Scroller
from ..names import domain_word
from ..sentences import translated
from ..theme.scale import L, M, S
from .history_model import HistoryModel
from .history_reader import HistoryReader
from .replaying import Replaying

if TYPE_CHECKING:
    from mtr_operator.evidence.verification import Verification
    from mtr_operator.replay.replay import ReplayedTest

_TABLE_HEIGHT = 120
_BOX_LETTERS = 10
_PROBLEMS_SHOWN = 2


class HistoryScreen(QWidget):
    """Attributes: search: text field. car, key, verdict: boxes. table. notice: how many there are, and what is wrong.

    open, repeat, compare, file, verify, anew, back: buttons.

    Signals: open_wanted(path), repeat_wanted(side), compare_wanted(comparison), replayed(path, ReplayedTest),
        file_wanted, closed.
    """

    open_wanted = pyqtSignal(object)
    repeat_wanted = pyqtSignal(object)
    compare_wanted = pyqtSignal(object)
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
        self._replaying: Replaying | None = None
        self._entries: Sequence[TestEntry] = ()
        self._summary = ""
        self._model = HistoryModel(self)
        self.search = QLineEdit()
        self.search.setPlaceholderText(self.tr("Search: VIN, key, day, operator, note"))
        self.search.setAccessibleName(self.tr("Search"))
        self.search.textChanged.connect(self._show)
        self.car = self._box(self.tr("Car"))
        self.key = self._box(self.tr("Key"))
        self.verdict = self._box(self.tr("Verdict"))
        self.table = self._make_table()
        self.notice = QLabel()
        self.notice.setWordWrap(True)
        self.open = self._button(self.tr("Open"), self._open)
        self.open.setProperty("role", "primary")
        self.repeat = self._button(self.tr("Repeat"), self._repeat)
        self.repeat.setToolTip(self.tr("A new test with the same parameters, car and key"))
        self.compare = self._button(self.tr("Compare two"), self._compare)
        self.file = self._button(self.tr("Open a file"), self.file_wanted.emit)
        self.verify = self._button(self.tr("Verify a bundle"), self._ask_bundle)
        self.verify.setToolTip(self.tr("Whether a bundle of evidence is as it was signed, by whom and when"))
        self.anew = self._button(self.tr("Compute anew"), self._replay)
        self.anew.setToolTip(self.tr("What would change in this test with the car profile as it is now, from its "
                                     "recorded log and poses"))
        self.back = self._button(self.tr("Back"), self.closed.emit)
        self._lay_out()
        self._show_choice()

    def _box(self, title: str) -> QComboBox:
        box = QComboBox()
        box.setAccessibleName(title)
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        box.setMinimumContentsLength(_BOX_LETTERS)
        box.addItem(title, "")
        box.currentIndexChanged.connect(self._show)
        return box

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
        filters, buttons, top = QHBoxLayout(), QHBoxLayout(), QHBoxLayout()
        top.addWidget(title, 1)
        top.addWidget(self.anew)
        top.addWidget(self.verify)
        for row, widgets in ((filters, (self.car, self.key, self.verdict)),
                             (buttons, (self.back, self.file, self.repeat, self.compare, self.open))):
            row.setSpacing(S)
            for widget in widgets:
                row.addWidget(widget, 1)
        column = QVBoxLayout()
        column.setSpacing(S)
        column.addLayout(top)
        # Its hint is longer than what three boxes leave of a laptop's width.
        column.addWidget(self.search)
        column.addLayout(filters)
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
        rows = sorted((index.row() for index in self.table.selectionModel().selectedRows()), reverse=True)
        return [self._model.entries[row] for row in rows]

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

    def _replay(self) -> None:
        self.anew.setEnabled(False)
        self.say(self.tr("{name} is being computed anew.").format(name=self.chosen[0].file.name))
        # No child of the screen, and no lambda: it may outlive it when the window is made anew.
        self._replaying = Replaying(self.chosen[0].file)
        self._replaying.replayed.connect(self._show_replayed)
        self._replaying.refused.connect(self._show_refused)
        self._replaying.start()

    def _show_replayed(self, path: pathlib.Path, found: ReplayedTest) -> None:
        self._show_choice()
        self.replayed.emit(path, found)

    def _show_refused(self, text: str) -> None:
        self._show_choice()
        self.say(translated(text))

    def _learn(self, entries: list[TestEntry]) -> None:
        self._entries = entries
        for box, name in ((self.car, "car"), (self.key, "key"), (self.verdict, "verdict")):
            values, chosen = values_of(entries, name), box.currentData()
            box.blockSignals(True)
            while box.count() > 1:
                box.removeItem(1)
            for value in values:
                box.addItem(domain_word(value) if name == "verdict" else value, value)
            box.setCurrentIndex(max(box.findData(chosen), 0))
            box.blockSignals(False)
        self._show()

    def _learn_all(self, entries: list[TestEntry]) -> None:
        self._learn(entries)
        problems = problems_of(entries)
        counted = self.tr("{count} tests, {shown} of them shown.").format(count=len(entries) - len(problems),
                                                                        shown=len(self.shown))
        more = len(problems) - _PROBLEMS_SHOWN
        tail = [self.tr("{count} more files cannot be read.").format(count=more)] if more > 0 else []
        self._summary = "\n".join([counted, *map(translated, problems[:_PROBLEMS_SHOWN]), *tail])
        self.say(self._summary)
        self.notice.setToolTip("\n".join(map(translated, problems)))

    def _show(self) -> None:
        before = set(map(_mark, self.chosen))
        text, car, key, verdict = (self.search.text(), *(box.currentData() or "" for box in
                                                         (self.car, self.key, self.verdict)))
        # Whoever looks for a car does not look for what nobody can read.
        broken = [] if car or key or verdict else unreadable(self._entries, text)
        self._model.show_entries([*matching(self._entries, text, car=car, key=key, verdict=verdict), *broken])
        # What grows while it is read must not take a choice away.
        for row, entry in enumerate(self._model.entries if before else ()):
            if _mark(entry) in before:
                whole = QItemSelection(self._model.index(row, 0), self._model.index(row, self._model.columnCount() - 1))
                self.table.selectionModel().select(whole, QItemSelectionModel.SelectionFlag.Select)
        self._show_choice()

    def _show_choice(self) -> None:
        chosen = self.chosen
        is_good = not any(entry.problem for entry in chosen)
        is_bundle_alone = len(chosen) == 1 and is_bundle(chosen[0].file)
        self.open.setEnabled(is_good and len(chosen) == 1 and not is_bundle_alone)
        self.anew.setEnabled(self.open.isEnabled() and not (self._replaying and self._replaying.isRunning()))
        self.repeat.setEnabled(is_good and len(chosen) == 1)
        self.compare.setEnabled(is_good and len(chosen) == 2)
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
            self.open_wanted.emit(self.chosen[0].file)

    def _repeat(self) -> None:
        try:
            self.repeat_wanted.emit(open_side(self.chosen[0].file))
        except OperatorError as error:
            self.say(translated(str(error)))

    def _compare(self) -> None:
        first, second = self.chosen
        try:
            self.compare_wanted.emit(compare(open_side(first.file), open_side(second.file)))
        except OperatorError as error:
            self.say(translated(str(error)))


def _mark(entry: TestEntry) -> str:
    """The same for a test in each copy of it, and in each look."""
    return entry.test_id or entry.path
