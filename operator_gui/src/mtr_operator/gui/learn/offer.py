"""Has the form of the CAN adapter open the dialog that learns a Car, and takes over the profile that it writes."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QEvent, QObject, Qt
from PyQt5.QtWidgets import QWidget

from ..flow import Flow
from ..forms.can_form import CanForm
from .learn_window import LearnWindow


class LearnOffer(QObject):
    """Lives as long as the window of the form, and so does the dialog: it has the adapter, and gives it back first."""

    def __init__(self, flow: Flow, form: CanForm, window: QWidget):
        super().__init__(window)
        self._flow, self._form = flow, form
        self._dialog: LearnWindow | None = None
        form.learn_wanted.connect(self._open)
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """See QObject; a minimized window is hidden by the system."""
        if event.type() == QEvent.Type.Hide and not event.spontaneous() and self._dialog:
            self._dialog.reject()
        return super().eventFilter(watched, event)

    def _open(self) -> None:
        choice = self._form.choice
        if choice is None:
            return
        if self._dialog is None:
            self._dialog = LearnWindow(self._flow, choice, self._flow.store.profile_folder, self._form.window())
            self._dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
            self._dialog.learned.connect(self._form.profile.setCurrentText)
            self._dialog.finished.connect(self._forget)
        self._dialog.show()
        self._dialog.raise_()
        self._dialog.activateWindow()

    def _forget(self) -> None:
        self._dialog = None
