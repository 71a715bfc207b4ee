"""A table that is only looked at: whole rows, as wide as what stands in them, scrolled where there is no room."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

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
