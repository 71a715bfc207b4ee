"""A table that is only looked at: whole rows, as wide as what stands in them, scrolled where there is no room."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QAbstractItemModel
from PyQt5.QtWidgets import QHeaderView, QTableView


def plain_table(name: str, min_height_px: int) -> QTableView:
    """A table; name: for a screen reader."""
    table = QTableView()
    table.setAccessibleName(name)
    table.setSelectionBehavior(QTableView.SelectRows)
    table.setAlternatingRowColors(True)
    # Tab leaves it.
    table.setTabKeyNavigation(False)
    table.verticalHeader().hide()
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    table.setHorizontalScrollMode(QTableView.ScrollMode.ScrollPerPixel)
    table.setMinimumHeight(min_height_px)
    return table


def show_in(table: QTableView, model: QAbstractItemModel) -> None:
    """Show another model; the one before, which Qt would keep with all that it knows, goes."""
    before, chosen = table.model(), table.selectionModel()
    table.setModel(model)
    for old in (chosen, before):
        if old is not None:
            old.deleteLater()
