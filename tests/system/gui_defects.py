"""A person uses the window under a window manager on a small laptop, and looks for the defects of its table.

Usage: gui_defects.py FOLDER; FOLDER/defects.json then says of each defect what is wrong, or nothing. The numbers are
those of the table from which the window was mended.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import sys
import traceback
from typing import Any, Callable, Dict, List

from gui_campaign import campaign
from gui_desk import Robot, window_manager
from gui_person import Person, button_of, run, visible_texts, xdotool
from gui_session import prepare
from PyQt5.QtCore import QPoint, QRect
from PyQt5.QtGui import QGuiApplication
from PyQt5.QtWidgets import QApplication, QDialog, QLabel, QWidget

from mtr_operator.gui.header.stop_button import StopButton
from mtr_operator.station.readiness import Phase

# For one step, and for a short test.
LIMIT_S = 20.0
MOST_TABS = 30


class Laptop:
    """The person, what they found, and the robot. Attributes: found: sentence of each defect, empty when it is mended.

    A picture of the screen at the first one goes to the folder."""

    def __init__(self, person: Person, robot: Robot, folder: pathlib.Path):
        self.person, self.robot, self.folder = person, robot, folder
        self.found: Dict[str, str] = {}

    @property
    def model(self) -> Any:
        """What the application knows."""
        return self.person.application.flow.model

    def look_for(self, numbers: str, check: Callable[["Laptop"], None]) -> None:
        """Note what a check finds of these defects. Behind one that fails the next ones cannot be told."""
        fault = "A defect before this one ended the session." if any(self.found.values()) else ""
        try:
            if not fault:
                check(self)
        except Exception:
            fault = traceback.format_exc()
            self.person.ask(lambda: QGuiApplication.primaryScreen().grabWindow(0).save(str(self.folder / "defect.png")))
        for number in numbers.split():
            self.found[number] = self.found.get(number, "") + fault

    def must(self, what: str, condition: Callable[[], Any]) -> None:
        """Wait for something that has to be so."""
        self.person.until(what, lambda: bool(condition()))

    def must_fit(self) -> None:
        """Every window, with its frame, is inside what the screen has free; so is every Stop that is shown."""
        self.must("a window inside the free part of the screen", lambda: all(map(_fits, _windows())))

    def rests(self) -> bool:
        """The robot may not move."""
        return not self.model.may_move


def _windows() -> List[QWidget]:
    return [each for each in QApplication.topLevelWidgets() if each.isVisible() and each.isWindow()
            and isinstance(each, QWidget) and each.windowTitle()]


def _fits(window: QWidget) -> bool:
    free = QGuiApplication.primaryScreen().availableGeometry()
    stops = [each for each in window.findChildren(StopButton) if each.isVisible() and each.window() is window]
    places = [QRect(each.mapToGlobal(QPoint(0, 0)), each.size()) for each in stops]
    return free.contains(window.frameGeometry()) and all(map(free.contains, places))


def header_stop(laptop: Laptop) -> StopButton:
    """Of the main window."""
    stop = laptop.person.application.window.header.stop
    assert isinstance(stop, StopButton)
    return stop


def press_stop(laptop: Laptop) -> None:
    """Click the main window's Stop where it is on the screen, whatever else is open."""
    place = laptop.person.until("Stop", lambda: header_stop(laptop).mapToGlobal(header_stop(laptop).rect().center()))
    xdotool("mousemove", str(place.x()), str(place.y()), "click", "1")


def connection(laptop: Laptop) -> None:
    """B6, B18, B19: before the robot is there."""
    person = laptop.person
    laptop.must_fit()
    person.type_into("IP address", "192.168.0.300")
    person.click("Connect")
    person.wait_for("The IP address or port provided is invalid.")
    person.type_into("IP address", "127.0.0.1")
    laptop.must("the sentence gone", lambda: not any("is invalid" in text for text in visible_texts()))
    person.choose("Language", "\u010ce\u0161tina")
    person.wait_for("P\u0159ipojit")
    person.choose("Jazyk", "English")
    person.wait_for("Connect")


def connect(laptop: Laptop) -> None:
    """A2, B10, B15: the main window of a robot that is ready."""
    person, robot = laptop.person, laptop.robot
    person.type_into("IP address", "127.0.0.1")
    person.type_into("Subscriber port", str(robot.status_port))
    person.type_into("Publisher port", str(robot.command_port))
    person.choose("CAN adapter", "Simulated Car (to try the application)")
    person.click("Connect")
    person.wait_for("What would you like to do?")
    laptop.must_fit()
    person.wait_for("The Car is locked.")
    person.wait_for("Ready")
    person.click("Ready")
    person.wait_for("Emergency stop")
    person.wait_for("Disk")
    person.press("Escape")
    laptop.must("the list gone", lambda: QApplication.activePopupWidget() is None)


def calibration(laptop: Laptop) -> None:
    """A1, B6, B8, B14: a click moves nothing; leaving it stops a robot that maps."""
    person = laptop.person
    person.click("Calibrate")
    person.wait_for("The Car's locks")
    laptop.must_fit()
    person.click("Hold to map it")
    assert laptop.rests(), "a click let the robot drive"
    person.hold("Hold to map it")
    laptop.must("Mapping", lambda: laptop.model.may_move)
    person.wait_for("Mapping")
    assert person.ask(lambda: isinstance(QApplication.focusWidget(), StopButton)), "the focus is not on Stop"
    person.press("Escape")
    laptop.must("the robot at rest", laptop.rests)
    person.hold("Hold to map it")
    laptop.must("Mapping", lambda: laptop.model.may_move)
    person.click("Close")
    laptop.must("the robot at rest after Close", laptop.rests)
    laptop.must("no dialog", lambda: not any(isinstance(each, QDialog) for each in _windows()))


def start(laptop: Laptop) -> None:
    """B8, B11: Enter presses the button that has the focus; Start is held."""
    person = laptop.person
    tab_to(laptop, "New test")
    person.press("Return")
    person.click("Key press")
    person.type_into("Degrees between radials", "120")
    person.wait_for("3 lines")
    laptop.must_fit()
    person.click("Hold to start")
    assert laptop.rests(), "a click let the robot drive"
    person.hold("Hold to start")
    laptop.must("a test that runs", lambda: laptop.model.phase is Phase.MEASURING)


def settings_while_measuring(laptop: Laptop) -> None:
    """A3, B6, B12: Settings leaves Stop at hand, and asks about an adapter that is not used."""
    person = laptop.person
    person.click("Settings")
    person.wait_for("Progress of tests")
    laptop.must_fit()
    press_stop(laptop)
    laptop.must("the test paused", lambda: laptop.model.phase is Phase.PAUSED)
    person.choose("CAN adapter", "slcan")
    person.click("Close")
    person.wait_for("is not in use yet. Use it?")
    person.click("Leave it as it was")
    laptop.must("no dialog", lambda: not any(isinstance(each, QDialog) for each in _windows()))


def keys_after_resume(laptop: Laptop) -> None:
    """A4, B5: after Resume Space stops, for the focus is on Stop; nothing of the paused screen is cut."""
    person = laptop.person
    laptop.must_fit()
    person.hold("Hold to resume")
    laptop.must("the test going on", lambda: laptop.model.phase is Phase.MEASURING)
    laptop.must("the focus on Stop", lambda: QApplication.focusWidget() is header_stop(laptop))
    person.press("space")
    laptop.must("the test paused", lambda: laptop.model.phase is Phase.PAUSED)
    faults = person.ask(lambda: [each.text() for each in laptop.person.application.window.screen.findChildren(QLabel)
                                 if each.isVisible() and each.wordWrap() and each.height() <
                                 each.heightForWidth(each.width())] or [""])
    assert faults == [""], f"cut: {faults}"


def lost_robot(laptop: Laptop) -> None:
    """B1, B2: what a silent robot said is grey with its age; its banner goes when it is back."""
    person = laptop.person
    person.hold("Hold to resume")
    laptop.must("the test going on", lambda: laptop.model.phase is Phase.MEASURING)
    laptop.robot.switch_off()
    person.wait_for("Communication lost")
    person.wait_for("s old.")
    assert not any("left" in text and "about" in text for text in person.ask(visible_texts)), "time is foretold"
    laptop.robot.switch_on()
    laptop.must("the robot heard", lambda: not laptop.model.is_stale)
    laptop.must("the test paused by the robot's restart", lambda: laptop.model.phase is Phase.PAUSED)
    laptop.must("no word of silence", lambda: not any("Communication lost" in text or "s old." in text
                                                      for text in visible_texts()))


def protocol(laptop: Laptop) -> None:
    """A5 to A9: the end of the test has figures with what they mean, and writes them by itself (B7)."""
    person = laptop.person
    person.hold("Hold to resume")
    person.follow("Key press protocol")
    laptop.must_fit()
    person.wait_for("Saved protocol.png, results.csv to")
    table = laptop.person.application.window.protocol.table.model()
    heads = [table.headerData(column, 1) for column in range(table.columnCount())]
    assert any("95 %" in head for head in heads), heads
    cells = [table.data(table.index(row, column)) for row in range(table.rowCount())
             for column in range(table.columnCount())]
    assert cells and not any("\u00b10 " in str(cell) or str(cell) == "0" for cell in cells), cells
    folder, = (person.application.flow.store.settings.result_folder).iterdir()
    text = (folder / "results.csv").read_text(encoding="utf-8")
    assert "# result" in text and len([line for line in text.splitlines() if not line.startswith("#")]) == 4
    person.click("New test")
    person.wait_for("What would you like to do?")


def leaving(laptop: Laptop) -> None:
    """A1, A3: closing while it measures stops the robot first, and asks."""
    person = laptop.person
    person.click("New test")
    person.click("Key press")
    person.wait_for("lines")
    person.hold("Hold to start")
    laptop.must("a test that runs", lambda: laptop.model.may_move)
    person.press("alt+F4")
    laptop.must("the robot at rest", laptop.rests)
    person.wait_for("Close the application?")
    laptop.must_fit()
    person.click("Stay")
    laptop.must("the window still there", person.application.window.isVisible)


def tab_to(laptop: Laptop, text: str) -> None:
    """Go on by Tab until the button with this text has the focus."""
    for _ in range(MOST_TABS):
        if laptop.person.ask(lambda: QApplication.focusWidget() is button_of(text)):
            return
        laptop.person.press("Tab")
    raise AssertionError(f"Tab does not reach {text}")


# Defects of the table beside what looks for them, in the order of a day.
CHECKS = (("B6 B18 B19", connection), ("A2 B10 B15", connect), ("A1 B6 B8 B14", calibration), ("B8 B11", start),
          ("A3 B6 B12", settings_while_measuring), ("A4 B5", keys_after_resume), ("B1 B2", lost_robot),
          ("A5 A6 A7 A8 A9 B7", protocol), ("B7 campaign", campaign), ("A1 A3", leaving))


def main(folder: pathlib.Path) -> int:
    """Look for all; the exit status."""
    robot, found = Robot(), {}

    def script(person: Person) -> None:
        laptop = Laptop(person, robot, folder)
        for numbers, check in CHECKS:
            laptop.look_for(numbers, check)
        found.update(laptop.found)
    robot.switch_on()
    try:
        with window_manager():
            status = run(script, prepare(folder), LIMIT_S)
    finally:
        robot.switch_off()
    (folder / "defects.json").write_text(json.dumps(found, indent=1), encoding="utf-8")
    return status


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
