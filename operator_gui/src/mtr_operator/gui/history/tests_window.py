"""What several tests say together: a picture of one distance beside a table of all, and what it means below."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import QSize
from PyQt5.QtWidgets import (
    QComboBox,
    QDialog,
    QHBoxLayout,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from mtr_operator.domain.geometry.pose import Point

from ..fitting.place import open_within
from ..fitting.plain_table import plain_table, show_in
from ..fitting.prose import Prose
from ..fitting.scroller import Scroller
from ..i18n import translate
from ..names import domain_word, identity_title
from ..pictures.layers.layer import Layer
from ..pictures.layers.points_layer import PointsLayer
from ..pictures.picture_panel import PicturePanel
from ..theme.appearance import Appearance
from ..theme.scale import L, M, S
from .table_model import TableModel

_SIZE = QSize(1300, 760)
_TABLE_HEIGHT = 200


class TestsWindow(QDialog):
    """Subclasses say what is in picture and rows, and call show_tests when they know it.

    Attributes: word: box of the distances. panel: the picture. table: a row for each distance. summary: what came out.
    """

    def __init__(self, words: Sequence[str], appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.word = QComboBox()
        self.word.setAccessibleName(translate("TestsWindow", "Distance"))
        for word in words:
            self.word.addItem(domain_word(word).capitalize(), word)
        self.word.setVisible(self.word.count() > 1)
        self.panel = PicturePanel(appearance)
        self.table = plain_table("", _TABLE_HEIGHT)
        self.summary = Prose()
        self._points = PointsLayer()
        self._lay_out()

    def show_tests(self, model: TableModel, table_name: str, summary: str) -> None:
        """Show what came out. table_name: for a screen reader."""
        show_in(self.table, model)
        self.table.setAccessibleName(table_name)
        self.summary.setText(summary)
        self.word.currentIndexChanged.connect(self._show_word)
        self.table.selectionModel().currentRowChanged.connect(lambda index, _: self._mark(index.row()))
        self._show_word()
        self.ensurePolished()
        open_within(self, _SIZE)

    def layers(self, word: str) -> tuple[Sequence[Layer], PointsLayer]:
        """Of the picture of a distance, from low to high, and the one of the points."""
        raise NotImplementedError

    def marked(self, row: int) -> tuple[str, tuple[Point, ...]]:
        """Which distance and points a row is about."""
        raise NotImplementedError

    def _lay_out(self) -> None:
        close = QPushButton(translate("TestsWindow", "Close"))
        close.setDefault(True)
        close.clicked.connect(self.accept)
        left, right, row = QVBoxLayout(), QVBoxLayout(), QHBoxLayout()
        left.setSpacing(S)
        left.addWidget(self.word)
        left.addWidget(self.panel, 1)
        right.setSpacing(M)
        right.addWidget(self.table, 1)
        right.addWidget(self.summary)
        right.addStretch(0)
        row.setSpacing(L)
        row.addLayout(left, 2)
        row.addWidget(Scroller(right), 3)
        below = QHBoxLayout()
        below.addStretch(1)
        below.addWidget(close)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(M, M, M, M)
        layout.setSpacing(M)
        layout.addLayout(row, 1)
        layout.addLayout(below)

    def _show_word(self) -> None:
        layers, self._points = self.layers(self.word.currentData())
        self.panel.legend.show_sets(self._points.sets)
        self.panel.view.show_layers(layers)

    def _mark(self, row: int) -> None:
        """Show which points a row is about."""
        if row < 0:
            return
        word, points = self.marked(row)
        self.word.setCurrentIndex(self.word.findData(word))
        self._points.chosen = points
        self.panel.view.refresh()


def circumstance_title(name: str) -> str:
    """Of something in which tests differ."""
    title = identity_title(name)
    return domain_word(name) if title == name else title
