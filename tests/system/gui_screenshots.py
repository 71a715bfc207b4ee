"""Keeps pictures of every window and screen in each theme, language and room, while a person tests a substitute robot.

Usage: gui_screenshots.py FOLDER [LANGUAGE ...] [--themes THEME ...] [--rooms ROOM ...]; what is not given: all of them.
The name of each picture says screen, room (gui_looks) and theme; contact sheets show all of a room and theme.
"""
# SPDX-License-Identifier: Apache-2.0
import argparse
import itertools
import pathlib
import shutil
import sys
from typing import Sequence

from gui_contact_sheet import contact_sheet
from gui_desk import Robot
from gui_looks import ROOMS, Camera
from gui_person import Person, run
from gui_room import SeeingRobot
from gui_session import LIMIT_S, prepare
from gui_words import words_of
from PyQt5.QtWidgets import QApplication

from mtr_operator.domain.ports import BusMessage, BusMessages, BusTraffic
from mtr_operator.gui.i18n import CZECH, ENGLISH
from mtr_operator.gui.theme.palette import THEMES
from mtr_operator.station.bus.bus_view import BusView

# A bus for the picture of its view: the substitute Car has none.
LOCKS = BusMessage(0x320, False, "LockStatus", 1234, 0.1, 0.04, bytes([1, 2, 0xAB]))
GONE = BusMessage(0x18FEF100, True, "", 7, None, 12.3, bytes(8))
BUS = BusMessages((LOCKS, GONE), 17), BusTraffic(0.234, 0.1, 0.1)
SIMULATED_CAR = "Simulated Car (to try the application)"


def main(arguments: Sequence[str]) -> int:
    """Take the pictures asked for; the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="of a folder of pictures for each language; emptied first")
    parser.add_argument("languages", nargs="*", metavar="LANGUAGE", help="en or cs; both without one")
    parser.add_argument("--themes", nargs="+", choices=list(THEMES), default=list(THEMES))
    parser.add_argument("--rooms", nargs="+", choices=list(ROOMS), default=list(ROOMS), help="sizes of the screen")
    options = parser.parse_args(arguments)
    status = max([_session(Camera(options.folder / language, options.themes, options.rooms), language)
                  for language in options.languages or (ENGLISH, CZECH)])
    print(f"{len(list(options.folder.glob('*/[0-9]*.png')))} pictures are in {options.folder}.")
    return status


def _session(camera: Camera, language: str) -> int:
    shutil.rmtree(camera.folder, ignore_errors=True)
    work = camera.folder / "run"
    work.mkdir(parents=True)
    robot = Robot(SeeingRobot)

    def script(person: Person) -> None:
        take_connection(person, camera)
        connect(person, robot)
        take_beginning(person, camera)
        take_autolock(person, camera, robot)
        take_key_press(person, camera, robot)
        take_history(person, camera)
        take_windows(person, camera)
        take_others(person, camera)
        person.ask(lambda: take_sheets(camera) or True)
    robot.switch_on()
    try:
        return run(script, prepare(work, language), LIMIT_S, words_of(language))
    finally:
        robot.switch_off()


def connect(person: Person, robot: Robot) -> None:
    """Fill in the connection window."""
    person.type_into("IP address", "127.0.0.1")
    person.type_into("Subscriber port", str(robot.status_port))
    person.type_into("Publisher port", str(robot.command_port))
    person.choose("CAN adapter", SIMULATED_CAR)
    person.click("Connect")
    person.wait_for("What would you like to do?")


def take_connection(person: Person, camera: Camera) -> None:
    """The connection window, also with a wrong address."""
    person.wait_for("Publisher port")
    person.look(camera, "01_connection")
    person.type_into("IP address", "192.168.0.300")
    person.click("Connect")
    person.wait_for("The IP address or port provided is invalid.")
    person.look(camera, "02_connection_invalid")
    person.type_into("Pairing code", "123")
    person.click("Pair")
    person.wait_for("192.168.0.300")
    person.look(camera, "02_pairing")
    person.choose("CAN adapter", "slcan")
    person.click("Learn a new Car from its bus")
    person.wait_for("You lock and unlock the Car")
    person.look(camera, "02_learn")
    close(person)


def take_beginning(person: Person, camera: Camera) -> None:
    """Welcome, calibration, settings, measurement types."""
    person.wait_for("Ready")
    person.look(camera, "03_welcome")
    person.click("Calibrate")
    person.click("Lock")
    person.click("Send")
    person.wait_for("Pressed for")
    person.look(camera, "04_calibration")
    person.click("Guided calibration")
    person.wait_for("Key's lever")
    person.look(camera, "04_guided_calibration")
    close(person)
    close(person)
    person.click("Settings")
    person.wait_for("Progress of tests")
    person.look(camera, "05_settings_window")
    close(person)
    person.click("New test")
    person.wait_for("What is to be measured?")
    person.look(camera, "06_measurement_type")


def take_autolock(person: Person, camera: Camera, robot: Robot) -> None:
    """The Autolock scenario from its settings to its protocol."""
    person.click("Autolock")
    person.type_into("Measurements distance", "1")
    person.look(camera, "07_autolock_settings")
    person.click("Car, key and operator")
    person.type_into("Car's VIN", "WVWZZZ1KZAW000001")
    person.type_into("Operator", "J. Novak")
    person.look(camera, "07_autolock_identity")
    person.click("Car, key and operator")
    person.type_into("Starting distance", "0,4")
    person.look(camera, "08_autolock_settings_invalid")
    person.type_into("Starting distance", "4")
    person.hold("Hold to start")
    person.follow("7 of 16 lines measured")
    with robot.slowly():
        person.look(camera, "09_autolock_measurement")
    person.click("Stop")
    person.wait_for("Paused.")
    person.click("Paused")
    person.wait_for("Emergency stop")
    person.look(camera, "10_autolock_paused")
    person.click("All events")
    person.until("the list of events", lambda: _count_windows() == 2)
    person.look(camera, "10_events")
    close(person)
    person.hold("Hold to resume")
    person.follow("Autolock protocol")
    person.wait_for("Saved protocol.png, results.csv to")
    person.look(camera, "11_autolock_protocol")
    person.click("New test")


def take_key_press(person: Person, camera: Camera, robot: Robot) -> None:
    """The Key press scenario from its settings to its protocol."""
    person.click("New test")
    person.click("Key press")
    person.wait_for("Degrees between radials")
    person.look(camera, "12_key_press_settings")
    person.type_into("Degrees between radials", "120")
    person.hold("Hold to start")
    person.follow("1 of 3 lines measured")
    with robot.slowly():
        person.look(camera, "13_key_press_measurement")
    person.follow("Key press protocol")
    person.look(camera, "14_key_press_protocol")
    person.click("Notes and photos")
    person.wait_for("Further photos")
    person.look(camera, "14_notes_and_photos")
    close(person)
    person.click("New test")


def take_history(person: Person, camera: Camera) -> None:
    """The tests of before, one of them repeated, both compared, and their spread."""
    table = person.application.window.history.table
    person.click("Tests so far")
    person.wait_for("2 tests, 2 of them shown.")
    person.look(camera, "15_history")
    person.choose_rows(table, 0)
    person.click("Repeat")
    person.hold("Hold to start")
    person.follow("Key press protocol")
    person.click("New test")
    person.click("Tests so far")
    person.wait_for("3 tests, 3 of them shown.")
    person.choose_rows(table, 0, 1)
    person.click("Compare two")
    person.wait_for("First: ")
    person.look(camera, "16_comparison")
    close(person)
    person.click("Spread")
    person.wait_for("The standard deviation is that of one test")
    person.look(camera, "16_spread")
    close(person)
    person.click("Back")


def take_windows(person: Person, camera: Camera) -> None:
    """The live bus view."""
    flow = person.application.flow
    lived = flow.bus_view
    flow.bus_view = lambda: BusView(*BUS, "", lived().moments, lived().events)
    person.click("The Car is locked.", "The Car is unlocked.")
    person.wait_for("Now: ")
    person.look(camera, "17_bus_view")
    close(person)


def take_others(person: Person, camera: Camera) -> None:
    """The other scenarios: the simulated Car has a handle, too."""
    person.click("New test")
    person.click("Zone map")
    person.wait_for("Hold to start")
    person.look(camera, "18_zone_map_settings")
    person.click("Back")
    person.click("Handle request")
    person.wait_for("Hold to start")
    person.look(camera, "19_handle_settings")
    person.type_into("Measurements distance", "2")
    person.hold("Hold to start")
    person.follow("Handle request protocol")
    person.look(camera, "20_handle_protocol")


def close(person: Person) -> None:
    """Close the window in front."""
    count = person.ask(_count_windows)
    person.click("Close")
    person.until("the window gone", lambda: _count_windows() < count)


def _count_windows() -> int:
    return len([each for each in QApplication.topLevelWidgets() if each.isVisible() and each.windowTitle()])


def take_sheets(camera: Camera) -> None:
    """A contact sheet of each room and theme."""
    for room, theme in itertools.product(camera.rooms, camera.themes):
        contact_sheet(sorted(camera.folder.glob(f"[0-9]*_{room}_{theme}.png")),
                      camera.folder / f"contact_sheet_{room}_{theme}.png")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
