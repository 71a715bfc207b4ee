"""The measurement screen: where the robot is, what it does and what is measured; Stop is in the header."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import time

from PyQt5.QtCore import QTimer, pyqtBoundSignal, pyqtSignal
from PyQt5.QtGui import QHideEvent, QKeySequence, QResizeEvent, QShowEvent
from PyQt5.QtWidgets import QHBoxLayout, QLabel, QPushButton, QShortcut, QVBoxLayout, QWidget

from mtr_operator.domain.clocks.simulated_time import is_simulated_robot
from mtr_operator.station.handle_prompt import HandlePrompt, Prompt
from mtr_operator.station.readiness import Phase, can_resume
from mtr_operator.station.view_model import ViewModel

from ..bridge import FRAME_MS
from ..fitting.prose import Prose
from ..fitting.scroller import Scroller
from ..forms.hold_button import HoldButton
from ..forms.hold_release import HoldRelease
from ..i18n import number
from ..pictures.measurement_picture import MeasurementPicture
from ..pictures.picture_panel import PicturePanel
from ..sentences import translated
from ..theme.appearance import Appearance
from ..theme.scale import L, M, S
from ..theme.state import show_state
from .measurement_facts import MeasurementFacts
from .results_so_far import ResultsSoFar

# Has no width, and a row may end there.
_BREAK = "\N{ZERO WIDTH SPACE}"
_SIDE_WIDTH, _MIN_SIDE_WIDTH = 400, 330
# From this height on the facts leave room for a table.
_TALL_PX = 880
# No plain letter: what is skipped by mistake has to be measured again.
_SKIP_KEY = "Ctrl+K"


class MeasurementScreen(QWidget):
    """Attributes: panel: the picture. facts: progress and state in words. so_far: table of the results.

    resume, save, events, leave: buttons.

    skip: button and key by which the line that is being measured is left.

    conditions: what is confirmed by resuming a test on a real robot.

    held: why the robot stands until the Operator has it go on. go_on: the button for that.
    handle: what the Operator is to do at the Car's handle or with the extender. taken: the button that says it is done.
    Signals: resume_wanted, skip_wanted, release_wanted, prompt_answered, save_wanted, events_wanted, leave_wanted;
        answered: nothing is asked any more of the person who had the focus on `taken`.
    """

    resume_wanted = pyqtSignal()
    skip_wanted = pyqtSignal()
    release_wanted = pyqtSignal()
    prompt_answered = pyqtSignal()
    save_wanted = pyqtSignal()
    events_wanted = pyqtSignal()
    leave_wanted = pyqtSignal()
    answered = pyqtSignal()

    def __init__(self, model: ViewModel, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("page")
        self._model = model
        self.panel = PicturePanel(appearance)
        self.picture = MeasurementPicture(model, self.panel)
        self.facts = MeasurementFacts()
        self.so_far = ResultsSoFar()
        self.so_far.hide()
        self.trouble, self.handle = (self._label("banner") for _ in range(2))
        self._hold = HoldRelease()
        self.held, self.go_on = self._hold.reason, self._hold.go_on
        self.go_on.held.connect(self.release_wanted)
        self.note = self._label("soft")
        self.conditions = self._label("soft")
        self.conditions.setText(self.tr("Who resumes is present, in sight of the robot, and confirms that the "
                                        "operating conditions hold."))
        self.conditions.hide()
        self.taken = self._button(self.tr("Handle taken"), "primary", self.prompt_answered)
        self.resume = self._hold_button(self.tr("Hold to resume"), self.resume_wanted)
        self.skip = self._button(self.tr("Skip the line"), "", self.skip_wanted)
        self.skip.setToolTip(self.tr("Leave the line that is being measured and go on with the next one (Ctrl+K); it "
                                     "can be measured again when the test is done"))
        self.skip.clicked.connect(lambda: self.skip.setEnabled(False))
        # A button's own shortcut would take the focus from Stop, and click a tenth of a second later.
        shortcut = QShortcut(QKeySequence(_SKIP_KEY), self)
        # Held down it would skip line after line.
        shortcut.setAutoRepeat(False)
        shortcut.activated.connect(self.skip.click)
        self.save = self._button(self.tr("Save progress"), "", self.save_wanted)
        self.events = self._button(self.tr("Events"), "", self.events_wanted)
        self.leave = self._button(self.tr("Back to the beginning"), "", self.leave_wanted)
        self._line = -1
        self._frames = QTimer(self)
        self._frames.setInterval(FRAME_MS)
        self._frames.timeout.connect(lambda: self.picture.glide(time.monotonic()))
        self._lay_out()

    @staticmethod
    def _label(role: str) -> QLabel:
        label = Prose()
        label.setProperty("role", role)
        return label

    @staticmethod
    def _button(text: str, role: str, signal: pyqtBoundSignal) -> QPushButton:
        button = QPushButton(text)
        button.setProperty("role", role)
        button.clicked.connect(signal)
        return button

    @staticmethod
    def _hold_button(text: str, signal: pyqtBoundSignal) -> HoldButton:
        """For what moves the robot."""
        button = HoldButton(text)
        button.setProperty("role", "primary")
        button.held.connect(signal)
        return button

    def _lay_out(self) -> None:
        told = QVBoxLayout()
        told.setSpacing(M)
        for label in (self.trouble, self.held, self.handle):
            told.addWidget(label)
        told.addWidget(self.facts, 1)
        told.addWidget(self.so_far, 2)
        told.addWidget(self.note)
        told.addWidget(self.conditions)
        side = QVBoxLayout()
        side.setSpacing(S)
        side.addWidget(Scroller(told), 1)
        for button in (self.go_on, self.taken, self.resume, self.skip):
            side.addWidget(button)
        row = QHBoxLayout()
        row.setSpacing(S)
        for button in (self.save, self.events):
            row.addWidget(button, 1)
        side.addLayout(row)
        side.addWidget(self.leave)
        holder = QWidget()
        holder.setMinimumWidth(_MIN_SIDE_WIDTH)
        holder.setMaximumWidth(_SIDE_WIDTH)
        side.setContentsMargins(0, 0, 0, 0)
        holder.setLayout(side)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(L, L, L, L)
        layout.setSpacing(L)
        layout.addWidget(self.panel, 3)
        layout.addWidget(holder, 2)

    def show_model(self) -> None:
        """Something of robot, Car or test is another one."""
        model = self._model
        if model.test is None:
            return
        self.picture.show_model(time.monotonic())
        self.facts.show_model(model)
        if not self.so_far.isHidden():
            self.so_far.show_model(model)
        self.trouble.setVisible(bool(model.trouble) and model.phase is Phase.PAUSED)
        self.trouble.setText(translated(model.trouble))
        self._show_cause(can_resume(model.readiness))
        self._hold.show_status(None if model.robot is None else model.robot.status)
        self._show_prompt()
        self._show_skip()
        self.resume.setVisible(model.phase is Phase.PAUSED)
        self.resume.setEnabled(can_resume(model.readiness))
        is_real = model.robot is not None and not is_simulated_robot(model.robot.status)
        self.conditions.setVisible(model.phase is Phase.PAUSED and is_real)
        self.leave.setVisible(model.phase is Phase.PAUSED)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """See QWidget."""
        super().resizeEvent(event)
        self.so_far.setVisible(event.size().height() >= _TALL_PX)
        self.show_model()

    def _show_skip(self) -> None:
        """Disabled from the click on until another line is measured."""
        line = self._model.line if self._model.phase is Phase.MEASURING else 0
        self.skip.setVisible(self._model.phase is Phase.MEASURING)
        if line != self._line:
            self._line = line
            self.skip.setText(self.tr("Skip line {number}").format(number=line) if line else self.tr("Skip the line"))
            self.skip.setEnabled(line != 0)

    def _show_cause(self, is_over: bool) -> None:
        """Why the test paused: red while it lasts."""
        show_state(self.trouble, "role", "notice" if is_over else "banner")

    def _show_prompt(self) -> None:
        """It has the focus, so that a person who comes back from the Car presses Enter."""
        prompt = self._model.prompt if self._model.phase is Phase.MEASURING else None
        if prompt is not None:
            self.handle.setText(self._question(prompt))
            self.taken.setText(self.tr("Handle taken") if isinstance(prompt, HandlePrompt)
                               else self.tr("Extender switched"))
        is_new = prompt is not None and self.taken.isHidden()
        is_over = prompt is None and self.taken.hasFocus()
        self.handle.setVisible(prompt is not None)
        self.taken.setVisible(prompt is not None)
        if is_new:
            self.taken.setFocus()
        elif is_over:
            self.answered.emit()

    def _question(self, prompt: Prompt) -> str:
        if isinstance(prompt, HandlePrompt):
            sentence = self.tr("Take the Car's handle now, with the Remote key at {distance} m, and then say so here, "
                               "by Enter or the button. "
                               "When the Car unlocks, nothing more is to be done.")
            return sentence.format(distance=number(prompt.distance_m, 2))
        if prompt.is_on:
            return self.tr("Switch the extender on now, and then say so here, by Enter or the button.")
        return self.tr("Switch the extender off now, and then say so here, by Enter or the button.")

    def say(self, sentence: str) -> None:
        """Show a sentence above the buttons; a path in it may go on in the next row."""
        self.note.setText(sentence.replace("/", f"/{_BREAK}").replace("_", f"_{_BREAK}"))

    def showEvent(self, event: QShowEvent) -> None:
        """See QWidget."""
        self._frames.start()
        self.say("")
        super().showEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        """See QWidget."""
        self._frames.stop()
        super().hideEvent(event)
