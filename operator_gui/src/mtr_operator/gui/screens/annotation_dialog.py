"""Notes and photos that belong to a test that is over: typed and chosen, and kept with its record."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QSize
from PyQt5.QtWidgets import QDialog, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.domain.errors import InvalidIdentity
from mtr_operator.domain.identity.identity import NOBODY, TITLES, Identity
from mtr_operator.station.identity_entry import Annotation

from ..fitting.breaks import breakable
from ..fitting.place import open_within
from ..fitting.scroller import Scroller
from ..forms.photos_row import PhotosRow
from ..forms.text_area import TextArea
from ..names import identity_title
from ..sentences import translated
from ..theme.scale import L, M

_SIZE = QSize(640, 460)


class AnnotationDialog(QDialog):
    """Attributes: notes. photos: further ones. kept: names of those that the test has already. keep: button.

    annotation: what was typed and chosen.
    """

    def __init__(self, identity: Identity | None, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(self.tr("Notes and photos"))
        self._identity = identity or NOBODY
        self.notes = TextArea(identity_title(TITLES["notes"]))
        self.notes.show_text(self._identity.notes)
        self.kept = QLabel()
        self.kept.setWordWrap(True)
        self.kept.setProperty("role", "soft")
        names = ", ".join(photo.name for photo in self._identity.photos)
        self.kept.setText(self.tr("With the test already: {names}.").format(names=breakable(names)))
        self.kept.setVisible(bool(names))
        self.photos = PhotosRow(self.tr("Further photos"))
        self.keep = QPushButton(self.tr("Keep with the test"))
        self.keep.setProperty("role", "primary")
        self._lay_out()
        self.notes.changed.connect(self._check)
        self.photos.changed.connect(self._check)
        self._check()
        self.ensurePolished()
        open_within(self, _SIZE)

    def _lay_out(self) -> None:
        cancel = QPushButton(self.tr("Close"))
        cancel.setAutoDefault(False)
        self.keep.setAutoDefault(False)
        self.keep.clicked.connect(self.accept)
        cancel.clicked.connect(self.reject)
        row = QHBoxLayout()
        row.addStretch(1)
        row.addWidget(self.keep)
        row.addWidget(cancel)
        column = QVBoxLayout()
        column.setSpacing(M)
        for widget in (self.notes, self.kept, self.photos):
            column.addWidget(widget)
        column.addStretch(1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(L, L, L, L)
        layout.setSpacing(M)
        layout.addWidget(Scroller(column), 1)
        layout.addLayout(row)

    @property
    def annotation(self) -> Annotation:
        """What was typed and chosen."""
        return Annotation(self.notes.text, self.photos.paths)

    def _check(self) -> None:
        fault = ""
        try:
            self.annotation.check(self._identity)
        except InvalidIdentity as error:
            fault = translated(str(error)).replace("notes", identity_title(TITLES["notes"]))
        self.notes.show_fault("" if self.photos.fault else fault)
        is_new = self.notes.text.strip() != self._identity.notes or bool(self.photos.paths)
        self.keep.setEnabled(is_new and not fault)
