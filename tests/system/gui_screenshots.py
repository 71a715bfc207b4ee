"""Keeps a picture of every window and screen in both themes, while a person tests the simulated robot and Car.

Usage: gui_screenshots.py FOLDER
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import shutil
import sys

from gui_contact_sheet import contact_sheet
from gui_person import Person, run
from gui_session import LIMIT_S, MEASURING_LIMIT_S, connect, prepare

from mtr_bringup.stack import Stack, StackOptions


def main(folder: pathlib.Path) -> int:
    """Take all pictures; the exit code."""
    shutil.rmtree(folder, ignore_errors=True)
    work = folder / "run"
    work.mkdir(parents=True)
    with Stack(StackOptions(work)) as stack:
        def script(person: Person) -> None:
            take_connection(person, folder)
            connect(person, str(stack.status_port), str(stack.command_port), str(stack.can_link))
            take_beginning(person, folder)
            take_autolock(person, folder)
            take_key_press(person, folder)
            take_history(person, folder)
            take_windows(person, folder)
            person.ask(lambda: take_sheets(folder) or True)
        status = run(script, prepare(work), LIMIT_S)
    print(f"{len(list(folder.glob('*.png')))} pictures are in {folder}.")
    return status


def take_connection(person: Person, folder: pathlib.Path) -> None:
    """The connection window, also with a wrong address."""
    person.wait_for("Publisher port")
    person.look(folder, "01_connection")
    person.type_into("IP address", "192.168.0.300")
    person.click("Connect")
    person.wait_for("The IP address or port provided is invalid.")
    person.look(folder, "02_connection_invalid")
    person.type_into("Pairing code", "123")
    person.click("Pair")
    person.wait_for("192.168.0.300")
    person.look(folder, "02_pairing")
    person.choose("CAN adapter", "slcan")
    person.click("Learn a new Car from its bus")
    person.wait_for("You lock and unlock the Car")
    person.look(folder, "02_learn")
    person.click("Close")


def take_beginning(person: Person, folder: pathlib.Path) -> None:
    """Welcome, calibration, settings, measurement types."""
    person.wait_for("Ready")
    person.look(folder, "03_welcome")
    person.click("Calibrate")
    person.click("Lock")
    person.click("Send")
    person.wait_for("Pressed for")
    person.look(folder, "04_calibration")
    person.click("Close")
    person.click("Settings")
    person.look(folder, "05_settings_window")
    person.click("Close")
    person.click("New test")
    person.look(folder, "06_measurement_type")


def take_autolock(person: Person, folder: pathlib.Path) -> None:
    """The Autolock scenario from its settings to its protocol."""
    person.click("Autolock")
    person.type_into("Measurements distance", "1")
    person.look(folder, "07_autolock_settings")
    person.click("Car, key and operator")
    person.type_into("Car's VIN", "WVWZZZ1KZAW000001")
    person.type_into("Operator", "J. Novak")
    person.look(folder, "07_autolock_identity")
    person.click("Car, key and operator")
    person.type_into("Starting distance", "0,4")
    person.look(folder, "08_autolock_settings_invalid")
    person.type_into("Starting distance", "4")
    person.hold("Hold to start")
    person.wait_for("7 of 16 lines measured", MEASURING_LIMIT_S)
    person.look(folder, "09_autolock_measurement")
    person.click("Stop")
    person.wait_for("Paused.")
    person.click("Paused")
    person.look(folder, "10_autolock_paused")
    person.press("Escape")
    person.hold("Hold to resume")
    person.wait_for("Autolock protocol", MEASURING_LIMIT_S)
    person.click("Save")
    person.wait_for("Saved protocol.png, results.csv to")
    person.look(folder, "11_autolock_protocol")
    person.click("New test")


def take_key_press(person: Person, folder: pathlib.Path) -> None:
    """The Key press scenario from its settings to its protocol."""
    person.click("New test")
    person.click("Key press")
    person.look(folder, "12_key_press_settings")
    person.hold("Hold to start")
    person.wait_for("4 of 8 lines measured", MEASURING_LIMIT_S)
    person.look(folder, "13_key_press_measurement")
    person.wait_for("Key press protocol", MEASURING_LIMIT_S)
    person.look(folder, "14_key_press_protocol")
    person.click("Notes and photos")
    person.wait_for("Further photos")
    person.look(folder, "14_notes_and_photos")
    person.click("Close")
    person.click("New test")


def take_history(person: Person, folder: pathlib.Path) -> None:
    """The tests of before, and one of them repeated."""
    person.click("Tests so far")
    person.wait_for("2 tests, 2 of them shown.")
    person.look(folder, "15_history")
    person.click("Back")


def take_windows(person: Person, folder: pathlib.Path) -> None:
    """The windows beside the main one: live bus view and guided calibration."""
    person.click("The Car is locked.", "The Car is unlocked.")
    person.wait_for("Now: ")
    person.look(folder, "16_bus_view")
    person.click("Close")
    person.click("Calibrate")
    person.click("Guided calibration")
    person.wait_for("Key's lever")
    person.look(folder, "17_guided_calibration")
    person.click("Close")
    person.click("Close")


def take_sheets(folder: pathlib.Path) -> None:
    """A contact sheet of each theme."""
    for theme in ("light", "dark"):
        contact_sheet(sorted(folder.glob(f"[0-9]*_{theme}.png")), folder / f"contact_sheet_{theme}.png")


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
