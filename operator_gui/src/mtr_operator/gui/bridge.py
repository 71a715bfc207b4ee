"""The one hop from the thread of the links into the GUI thread, at most once per frame."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import QElapsedTimer, QObject, QTimer, pyqtSignal

from mtr_operator.station.mailbox import Mailbox
from mtr_operator.station.view_model import ViewModel

from .sentences import robot_sentences

FRAME_MS = 33
# Without any event for so long the view still learns that the robot is silent, and time goes on.
HEARTBEAT_MS = 250


class Bridge(QObject):
    """Empties the mailbox into the view model.

    However often the mailbox wakes it, a frame passes between two batches; so the view's work does not grow with the
    number of messages.

    Attributes:
        mailbox: to be filled by any thread. model: to be read in the GUI thread.
        frames: how often the view was asked to show the model.
    Signals:
        happened: each event, in order, after the model has learnt it.
        changed: the model is another one than before.
    """

    happened = pyqtSignal(object)
    changed = pyqtSignal()
    _woken = pyqtSignal()

    def __init__(self, model: ViewModel, parent: QObject | None = None):
        super().__init__(parent)
        self.model = model
        self.mailbox = Mailbox(self._woken.emit)
        self.frames = 0
        self._frame = QTimer(self)
        self._frame.setSingleShot(True)
        self._delivered = QElapsedTimer()
        # Counts from the batch before: beside a robot that is heard it would only put off the next Status by a frame.
        self._heartbeat = QTimer(self)
        self._heartbeat.setInterval(HEARTBEAT_MS)
        self._frame.timeout.connect(self.deliver)
        self._heartbeat.timeout.connect(self.deliver)
        # Emitted in another thread: queued, and handled in this one.
        self._woken.connect(self._schedule)

    def start(self) -> None:
        """Begin the heartbeat."""
        self._heartbeat.start()

    def deliver(self) -> None:
        """Hand over what has come since."""
        self._delivered.start()
        if self._heartbeat.isActive():
            self._heartbeat.start()
        batch = self.mailbox.take()
        robot_sentences.learn(batch.said)
        self.model.apply(batch)
        self.frames += 1
        for event in batch.events:
            self.happened.emit(event)
        self.changed.emit()

    def _schedule(self) -> None:
        """At once after a pause, else when a frame has passed since the batch before."""
        if not self._frame.isActive():
            passed_ms = self._delivered.elapsed() if self._delivered.isValid() else FRAME_MS
            self._frame.start(max(FRAME_MS - passed_ms, 0))
