"""Languages: the translator, and the decimal sign of the language in use."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from PyQt5.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

FOLDER = pathlib.Path(__file__).parent / "translations"
ENGLISH, CZECH = "en", "cs"
translate = QCoreApplication.translate


class Language:
    """The language in use; one per application, so that its translator lives as long.

    Attributes:
        code: "en" or "cs".
    """

    def __init__(self) -> None:
        self.code = ENGLISH
        self._translator = QTranslator()
        self._qt_translator = QTranslator()

    def use(self, wanted: str) -> None:
        """Speak this language, or with "system" the system's, from now on; what is on the screen stays as it is."""
        app = QCoreApplication.instance()
        for translator in (self._translator, self._qt_translator):
            app.removeTranslator(translator)
        system = CZECH if QLocale.system().language() == QLocale.Language.Czech else ENGLISH
        self.code = system if wanted == "system" else wanted
        if self.code != ENGLISH and self._translator.load(str(FOLDER / f"mtr_operator_{self.code}.qm")):
            app.installTranslator(self._translator)
            # Names in the system's dialogs, where the installation of Qt has them.
            folder = QLibraryInfo.location(QLibraryInfo.LibraryLocation.TranslationsPath)
            if self._qt_translator.load(f"qtbase_{self.code}", folder):
                app.installTranslator(self._qt_translator)
        QLocale.setDefault(QLocale(self.code))


def language_code() -> str:
    """Code of the language in use."""
    return QLocale().name()[:2]


def decimal_sign() -> str:
    """Comma or point."""
    return QLocale().decimalPoint()


def number(value: float, digits: int) -> str:
    """A number with that many decimals, in the language in use."""
    return f"{value:.{digits}f}".replace(".", decimal_sign())


def duration(seconds: float) -> str:
    """Such as "1 h 05 min", "9 min", "40 s"."""
    if seconds < 90.0:
        return translate("Duration", "{seconds} s").format(seconds=max(0, round(seconds)))
    minutes = round(seconds / 60.0)
    if minutes < 60:
        return translate("Duration", "{minutes} min").format(minutes=minutes)
    return translate("Duration", "{hours} h {minutes:02d} min").format(hours=minutes // 60, minutes=minutes % 60)
