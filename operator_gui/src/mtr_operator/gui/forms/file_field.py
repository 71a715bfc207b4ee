"""A file that the Operator may give: its path, a button to choose it and one to do without."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Callable, Optional

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from ..dialogs import ask_yaml_file
from ..theme.scale import S
from .field import Field

# Has the Operator choose a file: parent of the dialog, its title, where it begins.
Ask = Callable[[QWidget, str, pathlib.Path], Optional[pathlib.Path]]


class FileField(QWidget):
    """Attributes: field: the path, or what is used without a file. choose, remove: buttons.

    Signals: changed: another file, or none.
    """

    changed = pyqtSignal()

    def __init__(self, title: str, without: str, hint: str, parent: QWidget | None = None, ask: Ask = ask_yaml_file):
        super().__init__(parent)
        self._title, self._ask = title, ask
        self._path: pathlib.Path | None = None
        self.field = Field(title)
        self.setToolTip(hint)
        self.field.edit.setReadOnly(True)
        self.field.edit.setPlaceholderText(without)
        self.choose = QPushButton(self.tr("Choose"))
        self.choose.setAccessibleName(self.tr("Choose a file: {what}").format(what=title))
        self.choose.clicked.connect(self._choose)
        self.remove = QPushButton(self.tr("Without"))
        self.remove.setAccessibleName(self.tr("Without a file: {what}").format(what=title))
        self.remove.clicked.connect(lambda: self._change(None))
        # Beside the line they would leave its hint no room on a laptop.
        buttons = QHBoxLayout()
        buttons.setSpacing(S)
        for button in (self.choose, self.remove):
            buttons.addWidget(button)
        buttons.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(S)
        layout.addWidget(self.field)
        layout.addLayout(buttons)
        self.show_path(None)
        self.show_fault("")

    @property
    def path(self) -> pathlib.Path | None:
        """The chosen file, None for none."""
        return self._path

    def show_path(self, path: pathlib.Path | None) -> None:
        """Show a file, without a signal."""
        self._path = path
        self.field.edit.setText("" if path is None else str(path))
        self.remove.setEnabled(path is not None)

    def show_fault(self, sentence: str) -> None:
        """Say what is wrong with the file; empty when nothing is."""
        self.field.show_fault(sentence)
        self.field.note.setVisible(bool(sentence))

    def _choose(self) -> None:
        start = pathlib.Path.home() if self._path is None else self._path.parent
        path = self._ask(self, self._title, start)
        if path is not None:
            self._change(path)

    def _change(self, path: pathlib.Path | None) -> None:
        self.show_path(path)
        self.changed.emit()
