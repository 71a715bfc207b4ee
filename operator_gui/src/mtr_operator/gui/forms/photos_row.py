"""Photos that are to be kept with a test: chosen, listed, taken away."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.domain.errors import InvalidIdentity
from mtr_operator.storage.photos import SUFFIXES, check_photos

from ..dialogs import ask_files
from ..fitting.breaks import breakable
from ..sentences import translated
from ..theme.scale import XS, S


class PhotosRow(QWidget):
    """Attributes: paths: chosen files. add, remove: buttons. names: what is chosen, or what is wrong with it.

    Signals: changed: other files are chosen.
    """

    changed = pyqtSignal()

    def __init__(self, title: str, parent: QWidget | None = None):
        super().__init__(parent)
        self._title = title
        self.paths: tuple[pathlib.Path, ...] = ()
        self.add = QPushButton(self.tr("Add photos"))
        self.add.clicked.connect(self._choose)
        self.remove = QPushButton(self.tr("Without"))
        self.remove.setAccessibleName(self.tr("Without photos"))
        self.remove.clicked.connect(lambda: self.show_paths(()))
        self.names = QLabel()
        self.names.setWordWrap(True)
        self.names.setProperty("role", "soft")
        buttons = QHBoxLayout()
        buttons.setSpacing(S)
        buttons.addWidget(self.add)
        buttons.addWidget(self.remove)
        buttons.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(XS)
        layout.addWidget(QLabel(title))
        layout.addLayout(buttons)
        layout.addWidget(self.names, 0, Qt.AlignmentFlag.AlignTop)
        self.show_paths(())

    @property
    def fault(self) -> str:
        """Why they cannot be kept; empty when they can."""
        try:
            check_photos(self.paths)
        except InvalidIdentity as error:
            return str(error)
        return ""

    def show_paths(self, paths: tuple[pathlib.Path, ...]) -> None:
        """Show these files."""
        self.paths = paths
        names = ", ".join(path.name for path in paths)
        self.names.setText(breakable(translated(self.fault) or names) or self.tr("none"))
        self.remove.setEnabled(bool(paths))
        self.changed.emit()

    def _choose(self) -> None:
        start = self.paths[-1].parent if self.paths else pathlib.Path.home()
        chosen = ask_files(self, self._title, start, " ".join(f"*{suffix} *{suffix.upper()}" for suffix in SUFFIXES))
        if chosen:
            self.show_paths(tuple(dict.fromkeys((*self.paths, *chosen))))
