"""Whole rows of a table that are chosen: asked and told for all at once, however many there are."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterable

from PyQt5.QtCore import QItemSelection, QItemSelectionModel
from PyQt5.QtWidgets import QTableView


def chosen_rows(table: QTableView) -> list[int]:
    """Their numbers, from the top."""
    ranges = table.selectionModel().selection()
    return sorted({row for part in ranges for row in range(part.top(), part.bottom() + 1)})


def choose_rows(table: QTableView, rows: Iterable[int]) -> None:
    """Choose these, too. Only one signal says so: who hears it looks at all that is chosen."""
    model, wanted = table.model(), QItemSelection()
    for first, last in _runs(rows):
        wanted.select(model.index(first, 0), model.index(last, model.columnCount() - 1))
    table.selectionModel().select(wanted, QItemSelectionModel.SelectionFlag.Select)


def _runs(rows: Iterable[int]) -> list[list[int]]:
    """First and last of those that follow each other; rows: in their order."""
    runs: list[list[int]] = []
    for row in rows:
        if runs and row == runs[-1][1] + 1:
            runs[-1][1] = row
        else:
            runs.append([row, row])
    return runs
