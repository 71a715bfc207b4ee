"""Pictures of all that is open: in each theme, at the room of each screen that the window is made for."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import Iterable, Iterator, List, NamedTuple, Tuple

from PyQt5.QtCore import QPoint, QRect, QSize
from PyQt5.QtGui import QColor, QPainter, QPixmap
from PyQt5.QtWidgets import QApplication, QWidget

from mtr_operator.gui.app import Application
from mtr_operator.gui.fitting import place
from mtr_operator.gui.header import popup
from mtr_operator.gui.header.popup import Popup
from mtr_operator.gui.theme.palette import THEMES

# What a panel leaves free, in pixels of the scale: a screen of twice as many at a scale of 2 looks the same, but finer.
ROOMS = {"1366x768": QSize(1366, 736), "1024x700": QSize(1024, 700), "1280x720_at_1.5": QSize(853, 480),
         "3840x2160_at_2": QSize(1920, 1080)}
# Layouts of labels that wrap come to rest in as many turns.
_TURNS = 3


# Of zlib's nine levels Qt makes the second one of it: half of the time of its default, for files a third larger.
_PNG_QUALITY = 80


class Camera(NamedTuple):
    """Keeps pictures in a folder: of these themes, at the room of these screens."""

    folder: pathlib.Path
    themes: Iterable[str] = tuple(THEMES)
    rooms: Iterable[str] = tuple(ROOMS)

    def look(self, application: Application, name: str) -> None:
        """Keep a picture of the windows that are open for each theme and room; all but the theme is as before then.

        Another theme takes up to a second, the longer the more there is in the window, so the one in use comes first.
        """
        windows = _windows()
        before = {window: (window.geometry(), window.minimumSize()) for window in windows}
        available, appearance = place.available, application.appearance
        try:
            for theme in sorted(self.themes, key=lambda each: THEMES[each] is not appearance.palette):
                if THEMES[theme] is not appearance.palette:
                    appearance.use(theme)
                for room in self.rooms:
                    _show_within(ROOMS[room], [(window, before[window][0].size()) for window in windows])
                    _picture(windows, ROOMS[room]).save(str(self.folder / f"{name}_{room}_{theme}.png"), "PNG",
                                                        _PNG_QUALITY)
        finally:
            place.available = popup.available = available
            for window, (geometry, least) in before.items():
                window.setMinimumSize(least)
                window.setGeometry(geometry)
            for opened in _popups(windows):
                opened.open_below(opened.parentWidget())
            _rest()


def _show_within(room: QSize, wanted: List[Tuple[QWidget, QSize]]) -> None:
    place.available = popup.available = lambda _window: QRect(QPoint(0, 0), room)
    for window, size in wanted:
        _suit(window, size)
    _rest()


def _windows() -> List[QWidget]:
    """The ones below first."""
    shown = [each for each in QApplication.topLevelWidgets() if each.isVisible()]
    return sorted(shown, key=lambda window: (isinstance(window, Popup), window.parentWidget() is not None,
                                             window is QApplication.activeWindow()))


def _popups(windows: List[QWidget]) -> Iterator[Popup]:
    return (window for window in windows if isinstance(window, Popup))


def _suit(window: QWidget, wanted: QSize) -> None:
    if isinstance(window, Popup):
        QApplication.processEvents()
        window.open_below(window.parentWidget())
    else:
        place.open_within(window, wanted)


def _rest() -> None:
    for _ in range(_TURNS):
        QApplication.processEvents()


def _picture(windows: List[QWidget], room: QSize) -> QPixmap:
    screen = QPixmap(room)
    screen.fill(QColor("gray"))
    painter = QPainter(screen)
    for window in windows:
        painter.drawPixmap(window.geometry().topLeft(), window.grab())
    painter.end()
    return screen
