"""A person at the Operator's window: reads what is visible, moves the mouse of the X server, types on its keyboard."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import subprocess
import sys
import threading
import time
import traceback
from typing import Any, Callable, List, Optional

from gui_looks import Camera
from gui_words import Words
from PyQt5.QtCore import QObject, QPoint, pyqtSignal
from PyQt5.QtWidgets import (
    QAbstractButton,
    QApplication,
    QComboBox,
    QLabel,
    QLineEdit,
    QScrollArea,
    QTableView,
    QWidget,
)

from mtr_operator.gui.app import Application, make_qt
from mtr_operator.gui.forms.hold_button import HoldButton
from mtr_operator.station.links import attention

POLL_S = 0.05
# Longer than a button has to be held.
HOLD_MORE_S = 0.5
# Time without a reaction after which the window counts as hanging in these tests, s; 1 s in use.
HANGING_S = 30.0


class GuiThread(QObject):
    """Runs functions in the GUI thread for another thread, also while a dialog is open."""

    _wanted = pyqtSignal(object)

    def __init__(self) -> None:
        super().__init__()
        self._wanted.connect(lambda run: run())

    def ask(self, function: Callable[[], Any]) -> Any:
        """Result of the function."""
        done, results = threading.Event(), []

        def run() -> None:
            try:
                results.append(function())
            finally:
                done.set()
        self._wanted.emit(run)
        done.wait()
        if not results:
            raise RuntimeError("The question to the window failed; see above.")
        return results[0]


class Person:
    """Looks for visible texts only, and knows nothing of the code behind them.

    Attributes: application: what the person sits at. words: of a window that does not speak English, in which the texts
        are given all the same.
    """

    def __init__(self, application: Application, gui: GuiThread, limit_s: float, words: Optional[Words] = None):
        self.application = application
        self.words = words
        self._gui = gui
        self._limit_s = limit_s

    def until(self, what: str, function: Callable[[], Any], limit_s: Optional[float] = None) -> Any:
        """The first true result of a function that is asked in the GUI thread."""
        deadline = time.monotonic() + (limit_s or self._limit_s)
        while time.monotonic() < deadline:
            result = self._gui.ask(function)
            if result:
                return result
            time.sleep(POLL_S)
        raise TimeoutError(f"{what} did not appear; visible is: {self._gui.ask(visible_texts)}")

    def ask(self, function: Callable[[], Any]) -> Any:
        """Result of a function in the GUI thread."""
        return self._gui.ask(function)

    def said(self, text: str) -> str:
        """A text as the window says it."""
        return text if self.words is None else self.words.of(text)

    def click(self, *texts: str) -> None:
        """Click the button with this text, or with the first of several that there is."""
        texts = tuple(map(self.said, texts))
        self._click(f"The button {' or '.join(texts)!r}",
                    lambda: place_of(next(filter(None, map(button_of, texts)), None)))

    def hold(self, text: str) -> None:
        """Hold the button with this text for as long as it wants to be held."""
        said = self.said(text)
        self._point_at(f"The button {said!r}", lambda: place_of(button_of(said)))
        xdotool("mousedown", "1")
        time.sleep(HoldButton.HOLD_MS / 1000.0 + HOLD_MORE_S)
        xdotool("mouseup", "1")

    def wait_for(self, text: str, limit_s: Optional[float] = None) -> None:
        """Wait until a text with this part is visible."""
        said = self.said(text)
        self.until(f"{said!r}", lambda: any(said in shown for shown in visible_texts()), limit_s)

    def follow(self, text: str) -> None:
        """Wait until a text with this part is visible, for as long as what is visible changes: how long a test takes is
        the machine's matter, and one that stands still is not waited for."""
        said, deadline, before = self.said(text), 0.0, None
        while True:
            shown_now = self._gui.ask(visible_texts)
            if any(said in each for each in shown_now):
                return
            if shown_now != before:
                before, deadline = shown_now, time.monotonic() + self._limit_s
            elif time.monotonic() > deadline:
                raise TimeoutError(f"{said!r} did not appear; visible is: {shown_now}")
            time.sleep(POLL_S)

    def type_into(self, label: str, text: str) -> None:
        """Replace what stands in the field with this label."""
        label = self.said(label)
        self._click(f"The field {label!r}", lambda: place_of(field_of(label, QLineEdit)))
        focus = self._gui.ask(lambda: int(QApplication.activeWindow().winId()) if QApplication.activeWindow() else 0)
        if focus:
            xdotool("windowfocus", "--sync", str(focus))
        xdotool("key", "ctrl+a", "type", "--delay", "1", text)
        self.until(f"{text!r} in {label!r}", lambda: field_of(label, QLineEdit).text() == text)

    def choose(self, label: str, entry: str) -> None:
        """Choose an entry of the list with this label."""
        label, entry = self.said(label), self.said(entry)
        self._click(f"The list {label!r}", lambda: place_of(field_of(label, QComboBox)))
        self._click(f"The entry {entry!r}", lambda: place_of_entry(label, entry))
        # A choice of another language takes the label away.
        self.until(f"{entry!r} chosen", lambda: (box := field_of(label, QComboBox)) is None
                   or entry in box.currentText())

    def choose_rows(self, table: QTableView, *rows: int) -> None:
        """Click rows of a table, from the second one on with Ctrl."""
        for number, row in enumerate(rows):
            self._point_at("a row", lambda row=row: _place_of_row(table, row))
            xdotool(*(["keydown", "ctrl", "click", "1", "keyup", "ctrl"] if number else ["click", "1"]))

    def look(self, camera: Camera, name: str) -> None:
        """Keep pictures of what is open."""
        self._gui.ask(lambda: camera.look(self.application, name) or True)

    def press(self, key: str) -> None:
        """Press a key."""
        xdotool("key", key)

    def _point_at(self, what: str, find: Callable[[], Optional[QPoint]]) -> None:
        """Move the mouse there, and look again: a sentence that has just come may not have moved it yet."""
        place, there = self.until(what, find), None
        while place != there:
            there = place
            xdotool("mousemove", str(there.x()), str(there.y()))
            place = self.until(what, find)

    def _click(self, what: str, find: Callable[[], Optional[QPoint]]) -> None:
        self._point_at(what, find)
        xdotool("click", "1")


def _place_of_row(table: QTableView, row: int) -> Optional[QPoint]:
    if table.model().rowCount() <= row:
        return None
    rect = table.visualRect(table.model().index(row, 0))
    return table.viewport().mapToGlobal(rect.center()) if rect.isValid() else None


def xdotool(*words: str) -> None:
    """Move, click or type on the X server."""
    subprocess.run(["xdotool", *words], check=True, timeout=20)


def shown(kind: type) -> List[QWidget]:
    """Visible widgets of a kind: of a list that is open alone, else those of the window in front first."""
    front = QApplication.activePopupWidget() or QApplication.activeModalWidget()
    active = QApplication.activeWindow()
    windows = [front] if front else sorted(QApplication.topLevelWidgets(), key=lambda window: window is not active)
    return [widget for window in windows for widget in [window, *window.findChildren(QWidget)]
            if isinstance(widget, kind) and widget.isVisible()]


def text_of(widget: QWidget) -> str:
    """What a person reads on it; a symbol is called by its name."""
    return getattr(widget, "title", None) or widget.text() or widget.accessibleName()


def visible_texts() -> List[str]:
    """Everything that can be read."""
    return [text for text in map(text_of, [*shown(QLabel), *shown(QAbstractButton)]) if text]


def button_of(text: str) -> Optional[QWidget]:
    """Enabled button that ends with this text; signs may precede it."""
    found = [button for button in shown(QAbstractButton) if text_of(button).endswith(text) and button.isEnabled()]
    return found[0] if found else None


def field_of(label: str, kind: type) -> Optional[QWidget]:
    """Field that belongs to a label, or is called so for a screen reader."""
    found = [each.buddy() for each in shown(QLabel) if each.text() == label and isinstance(each.buddy(), kind)]
    found += [each for each in shown(kind) if each.accessibleName() == label]
    return found[0] if found else None


def place_of(widget: Optional[QWidget]) -> Optional[QPoint]:
    """Middle of a widget on the screen; what is out of sight is scrolled to, as the wheel does."""
    if widget is None:
        return None
    parent = widget.parentWidget()
    while parent is not None:
        if isinstance(parent, QScrollArea) and not widget.visibleRegion().contains(widget.rect()):
            parent.ensureWidgetVisible(widget)
        parent = parent.parentWidget()
    return widget.mapToGlobal(widget.rect().center())


def place_of_entry(label: str, entry: str) -> Optional[QPoint]:
    """Middle of an entry of a list that is open."""
    boxes = [widget for window in QApplication.topLevelWidgets() for widget in window.findChildren(QComboBox)]
    for box in boxes:
        view = box.view()
        if box.accessibleName() == label and view.isVisible():
            index = box.findText(entry)
            if index >= 0:
                return view.viewport().mapToGlobal(view.visualRect(box.model().index(index, 0)).center())
    return None


def run(script: Callable[[Person], None], settings_path: pathlib.Path, limit_s: float,
        words: Optional[Words] = None) -> int:
    """Open the application and let a person follow the script; the exit code. words: see Person."""
    # With the whole stack on a busy machine the window reacts late; other tests cover a window that hangs.
    attention.LIMIT_S = HANGING_S
    app = make_qt()
    application, gui = Application(settings_path), GuiThread()
    application.open()
    status = [1]

    def follow() -> None:
        person = Person(application, gui, limit_s, words)
        try:
            script(person)
            status[0] = 0
        # Whatever goes wrong must end the application, or nobody would.
        except Exception:
            traceback.print_exc(file=sys.stderr)
            gui.ask(lambda: app.primaryScreen().grabWindow(0).save(str(settings_path.with_name("failure.png"))))
        gui.ask(lambda: app.quit() or True)
    thread = threading.Thread(target=follow, daemon=True)
    thread.start()
    app.exec_()
    application.close()
    thread.join(limit_s)
    return status[0]
