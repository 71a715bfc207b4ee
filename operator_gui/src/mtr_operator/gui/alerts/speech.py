"""A voice that says aloud what the Operator has to hear, where the computer has one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import importlib
from typing import Any

from PyQt5.QtCore import QLocale

from ..i18n import language_code

_MODULE = "PyQt5.QtTextToSpeech"


def speech_module() -> Any:
    """Qt's text to speech; None where it is not installed, as with Debian's python3-pyqt5 alone."""
    try:
        return importlib.import_module(_MODULE)
    except ImportError:
        return None


class Voice:
    """module: see speech_module. The engine begins with the first sentence, for that takes a while."""

    def __init__(self, module: Any = None):
        self._speech: Any = None if module is None else module.QTextToSpeech
        self._engine: Any = None

    @property
    def can_speak(self) -> bool:
        """True when the computer has an engine for speech."""
        return self._speech is not None and bool(self._speech.availableEngines())

    def say(self, text: str) -> None:
        """Say it in the language of the window, instead of what is being said; nothing without an engine or a text."""
        if not text or not self.can_speak:
            return
        if self._engine is None:
            self._engine = self._speech()
        self._engine.stop()
        self._engine.setLocale(QLocale(language_code()))
        self._engine.say(text)
