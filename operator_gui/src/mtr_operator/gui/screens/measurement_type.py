"""Choice of the scenario: one tile for each that is registered."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Mapping

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.domain.scenario import AnyScenario

from ..fitting.scroller import Scroller
from ..names import scenario_doc, scenario_title
from ..theme.scale import XL, L, M, S
from .tile import Tile

_WIDTH = 620


class MeasurementTypeScreen(QWidget):
    """Attributes: tiles: by scenario. Signals: chosen(name), back."""

    chosen = pyqtSignal(str)
    back = pyqtSignal()

    def __init__(self, scenarios: Mapping[str, AnyScenario], parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("page")
        title = QLabel(self.tr("What is to be measured?"))
        title.setProperty("role", "title")
        column = QVBoxLayout()
        column.setSpacing(M)
        column.addStretch(2)
        column.addWidget(title)
        column.addSpacing(S)
        self.tiles: dict[str, Tile] = {}
        for name, scenario in scenarios.items():
            tile = Tile(scenario_title(scenario), scenario_doc(scenario))
            tile.setFixedWidth(_WIDTH)
            tile.clicked.connect(lambda _checked, name=name: self.chosen.emit(name))
            self.tiles[name] = tile
            column.addWidget(tile)
        back = QPushButton(self.tr("Back"))
        back.clicked.connect(self.back)
        below = QHBoxLayout()
        below.addWidget(back)
        below.addStretch(1)
        column.addSpacing(M)
        column.addLayout(below)
        column.addStretch(3)
        row = QHBoxLayout()
        row.addStretch(1)
        row.addLayout(column)
        row.addStretch(1)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(XL, L, XL, L)
        layout.addWidget(Scroller(row))
