"""A person runs a short Key press test in the window, from connecting to saved files.

Usage: gui_session.py SUBSCRIBER_PORT PUBLISHER_PORT CAN_CHANNEL FOLDER
"""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import os
import pathlib
import sys

from gui_person import Person, run

from mtr_operator.station.settings import Settings
from mtr_operator.station.settings_file import SettingsStore

# Wall time for one step, and for the whole measuring.
LIMIT_S = 60.0
MEASURING_LIMIT_S = 400.0


def prepare(folder: pathlib.Path, language: str = "en") -> pathlib.Path:
    """Settings that keep all files in the folder; their path. What the system keeps for programs is there, too."""
    os.environ["XDG_DATA_HOME"] = str(folder / "data")
    os.environ.pop("MTR_RESULTS_STORE", None)
    path = folder / "settings.json"
    SettingsStore(path).change(dataclasses.replace(Settings(), language=language, theme="light",
                                                   result_folder=folder / "results",
                                                   progress_folder=folder / "progress"))
    return path


def connect(person: Person, subscriber_port: str, publisher_port: str, channel: str) -> None:
    """Fill in the connection window."""
    person.type_into("IP address", "127.0.0.1")
    person.type_into("Subscriber port", subscriber_port)
    person.type_into("Publisher port", publisher_port)
    person.choose("CAN adapter", "slcan")
    person.type_into("Channel", channel)
    person.click("Connect")
    person.wait_for("What would you like to do?")


def measure(person: Person) -> None:
    """Two radials, with a pause after the first one."""
    person.click("New test")
    person.click("Key press")
    person.type_into("Degrees between radials", "180")
    person.wait_for("2 lines")
    person.wait_for("Ready")
    person.hold("Hold to start")
    person.wait_for("1 of 2 lines measured", MEASURING_LIMIT_S)
    person.click("Stop")
    person.wait_for("Paused.")
    person.click("Save progress")
    person.wait_for("Saved to")
    person.hold("Hold to resume")
    person.wait_for("Key press protocol", MEASURING_LIMIT_S)


def save(person: Person) -> None:
    """Save CSV and PNG, and go back to the beginning."""
    person.click("Save")
    person.wait_for("Saved protocol.png, results.csv to")
    person.click("New test")
    person.wait_for("What would you like to do?")


def main(subscriber_port: str, publisher_port: str, channel: str, folder: str) -> int:
    """Run the whole session; the exit code."""
    def script(person: Person) -> None:
        connect(person, subscriber_port, publisher_port, channel)
        measure(person)
        save(person)
    return run(script, prepare(pathlib.Path(folder)), LIMIT_S)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
