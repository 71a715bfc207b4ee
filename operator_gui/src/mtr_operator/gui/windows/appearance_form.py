"""How the window looks and sounds: theme, language, beeps, speech."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from typing import Any

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QCheckBox, QComboBox, QLabel, QVBoxLayout, QWidget

from mtr_operator.station.settings import THEMES

from ..alerts.speech import Voice, speech_module
from ..flow import Flow
from ..forms.language_box import LanguageBox
from ..theme.appearance import Appearance
from ..theme.scale import XS, M


class AppearanceForm(QWidget):
    """Attributes: theme, language: combo boxes. sounds, speech: check boxes. Each is in force when it is chosen.

    Signals: changed: the settings are others.
    """

    changed = pyqtSignal()

    def __init__(self, flow: Flow, appearance: Appearance, parent: QWidget | None = None):
        super().__init__(parent)
        self._flow = flow
        self._appearance = appearance
        settings = flow.store.settings
        self.theme = self._theme_box(settings.theme)
        self.language = LanguageBox(settings.language)
        self.sounds = QCheckBox(self.tr("Sounds"))
        self.sounds.setToolTip(self.tr("One beep when the robot begins to move, two when the test is done, three at "
                                       "trouble"))
        self.sounds.setChecked(settings.has_sounds)
        self.speech = self._speech_box(settings.speaks)
        self._lay_out()
        self.theme.currentIndexChanged.connect(self._change_theme)
        self.language.currentIndexChanged.connect(lambda _: flow.use_language(self.language.currentData()))
        self.sounds.toggled.connect(lambda is_wanted: self._change(has_sounds=is_wanted))
        self.speech.toggled.connect(lambda is_wanted: self._change(speaks=is_wanted))

    def _theme_box(self, chosen: str) -> QComboBox:
        names = {"system": self.tr("As the system"), "light": self.tr("Light"), "dark": self.tr("Dark"),
                 "contrast": self.tr("High contrast")}
        box = QComboBox()
        for theme in THEMES:
            box.addItem(names[theme], theme)
        box.setCurrentIndex(THEMES.index(chosen))
        return box

    def _speech_box(self, is_wanted: bool) -> QCheckBox:
        box = QCheckBox(self.tr("Speech"))
        box.setChecked(is_wanted)
        box.setEnabled(Voice(speech_module()).can_speak)
        box.setToolTip(
            self.tr("Says what the beeps mean, and what the trouble is") if box.isEnabled() else
            self.tr("This computer cannot speak: Qt's text to speech or an engine for it is missing (Debian: "
                    "python3-pyqt5.qttexttospeech, speech-dispatcher)"))
        return box

    def _lay_out(self) -> None:
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(M)
        for title, box in ((self.tr("Theme"), self.theme), (self.tr("Language"), self.language)):
            label = QLabel(title)
            label.setBuddy(box)
            box.setAccessibleName(title)
            group = QVBoxLayout()
            group.setSpacing(XS)
            group.addWidget(label)
            group.addWidget(box)
            layout.addLayout(group)
        layout.addWidget(self.sounds)
        layout.addWidget(self.speech)

    def _change_theme(self) -> None:
        self._change(theme=self.theme.currentData())
        self._appearance.use(self.theme.currentData())

    def _change(self, **changes: Any) -> None:
        self._flow.store.change(dataclasses.replace(self._flow.store.settings, **changes))
        self.changed.emit()
