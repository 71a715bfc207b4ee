"""Car profiles: the shipped one, a second car with the other polarity, and everything that may be wrong in a file."""
# SPDX-License-Identifier: Apache-2.0
import threading

import cantools
import pytest

from mtr_operator.car_link.outputs.declared import DeclaredOutput
from mtr_operator.car_link.outputs.extender import BusExtender
from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import KEY_BUTTON, PASSIVE_ENTRY, LockState

OTHER_DBC = """VERSION ""
BU_: GW
BO_ 2566848513 Doors: 8 GW
 SG_ Closed : 20|1@0+ (1,0) [0|1] "" GW
 SG_ Speed : 32|16@1+ (0.01,0) [0|655.35] "km/h" GW
"""
OTHER_ID = 2566848513 & 0x1FFFFFFF
OTHER_PROFILE = """description: another car
database: other.dbc
message: Doors
signal: Closed
states: {0: unlocked, 1: locked}
cycle_time_s: 0.1
sent_on_change: true
"""


def write(folder, profile=OTHER_PROFILE, dbc=OTHER_DBC):
    """Path of a profile in the folder, with its database."""
    (folder / "other.dbc").write_text(dbc)
    path = folder / "other.yaml"
    path.write_text(profile)
    return str(path)


@pytest.mark.parametrize("path", sorted(PROFILE_FOLDER.glob("*.yaml")), ids=lambda path: path.stem)
def test_shipped_profile_loads(path):
    assert load_profile(path.stem).name == path.stem


@pytest.mark.parametrize(("raw", "state"), [
    (0, LockState.LOCKED), (1, LockState.UNLOCKED), (2, LockState.UNKNOWN), (3, LockState.UNKNOWN)])
def test_demo_car_is_decoded_as_its_database_says(raw, state):
    profile = load_profile("mtr_demo_car")
    database = cantools.database.load_file(str(PROFILE_FOLDER / "mtr_demo_car.dbc"))
    message = database.get_message_by_name("DoorLockStatus")
    values = {signal.name: 1 for signal in message.signals}
    data = message.encode({**values, "LockState": raw})
    assert profile.decode(message.frame_id, False, data)[:2] == (state, "passive_entry")


def test_database_of_diagnostics_is_a_sentence(tmp_path, monkeypatch):
    path = write(tmp_path)
    diagnostics = cantools.database.diagnostics.Database()
    monkeypatch.setattr("cantools.database.load_string", lambda *_, **__: diagnostics)
    with pytest.raises(ConnectionFailed, match=r"other\.dbc has no message Doors"):
        load_profile(path)


@pytest.mark.parametrize(("raw", "source"), [(0, ""), (1, PASSIVE_ENTRY), (2, KEY_BUTTON), (7, "")])
def test_demo_car_says_what_made_its_locks_move(raw, source):
    profile = load_profile("mtr_demo_car")
    values = {signal.name: 0 for signal in profile.message.signals}
    data = profile.message.encode({**values, "LastCommandSource": raw})
    assert profile.decode(profile.message.frame_id, False, data).source == source


def test_demo_profile_has_the_cycle_time_of_its_database():
    profile = load_profile("mtr_demo_car")
    assert profile.cycle_time_s * 1000 == profile.message.cycle_time


def test_second_car_with_other_polarity_needs_only_files(tmp_path):
    profile = load_profile(write(tmp_path))
    assert profile.decode(OTHER_ID, True, bytes(8))[:2] == (LockState.UNLOCKED, "")
    assert profile.decode(OTHER_ID, True, bytes([0, 0, 0x10, 0, 0, 0, 0, 0]))[:2] == (LockState.LOCKED, "")
    assert (profile.cycle_time_s, profile.sent_on_change) == (0.1, True)


def test_other_frames_are_not_the_lock_message(tmp_path):
    profile = load_profile(write(tmp_path))
    assert profile.decode(OTHER_ID + 1, True, bytes(8)) is None
    assert profile.decode(OTHER_ID, False, bytes(8)) is None
    assert profile.decode(OTHER_ID, True, bytes(1)) is None


@pytest.mark.parametrize(("change", "words"), [
    (("message: Doors", "message: Windows"), "no message Windows"),
    (("signal: Closed", "signal: Open"), "no signal Open"),
    (("database: other.dbc", "database: lost.dbc"), "lost.dbc cannot be read: No such file"),
    (("cycle_time_s: 0.1", "cycle_time_s: 0"), "cycle_time_s is 0; allowed is 0.001 to 10 s"),
    (("cycle_time_s: 0.1\n", ""), "lacks the entry cycle_time_s"),
    (("1: locked", "1: shut"), "states has 1: 'shut'; allowed is a whole number with unknown, locked, unlocked or "
                                      "unlocked_driver"),
    (("sent_on_change: true", "source_signal: Speed"), "source_signal and sources belong together"),
    (("sent_on_change: true", "sources: {1: key_button}"), "source_signal and sources belong together"),
    (("sent_on_change: true", "source_signal: Why\nsources: {1: key_button}"), "no signal Why"),
    (("sent_on_change: true", "source_signal: Speed\nsources: {1: wind}"),
     "sources has 1: 'wind'; allowed is a whole number with passive_entry, key_button or handle"),
    (("1: locked", "1: unknown"), "must name a value for locked and one for unlocked"),
    (("{0: unlocked, 1: locked}", "locked"), "must be a table"),
    (("description: another car", "colour: red"), "unknown entry colour"),
    (("other.dbc", 300 * "a" + ".dbc"), "File name too long"),
    (("other.dbc", 5000 * "a"), "has a text of more than 1000 characters"),
    (("1: locked", "1: " + 5000 * "a"), "has a text of more than 1000 characters"),
    (("description: another car", "{"), "is not valid YAML in line 3; a profile is"),
    ((OTHER_PROFILE, "just words"), "no table")])
def test_wrong_profile_is_refused_with_a_sentence(tmp_path, change, words):
    with pytest.raises(ConnectionFailed) as raised:
        load_profile(write(tmp_path, OTHER_PROFILE.replace(*change)))
    assert words in str(raised.value)
    assert "\n" not in str(raised.value) and len(str(raised.value)) < 2000


def test_profile_by_a_name_that_no_file_can_have_is_refused_with_a_sentence():
    with pytest.raises(ConnectionFailed, match="There is no car profile"):
        load_profile(300 * "a")


def with_handle(entry):
    """A change of the profile that declares an output."""
    return "sent_on_change: true", f"handle_request: {entry}"


def test_output_that_takes_the_handle_is_sent_as_its_message(tmp_path):
    change = with_handle("{message: Doors, signal: Speed, taken: 258, released: 0}")
    output = load_profile(write(tmp_path, OTHER_PROFILE.replace(*change))).handle_output
    taken, released = output.frame(True), output.frame(False)
    assert taken.is_extended_id and taken.arbitration_id == OTHER_ID
    assert bytes(taken.data) == bytes(4) + b"\x02\x01" + bytes(2) and bytes(released.data) == bytes(8)
    assert load_profile(write(tmp_path)).handle_output is None


@pytest.mark.parametrize(("entry", "words"), [
    ("1", "handle_request must be a table of message, signal, taken, released"),
    ("{message: Doors, signal: Speed, taken: 1}", "must be a table of message, signal, taken, released"),
    ("{message: Doors, signal: Speed, taken: yes, released: 0}", "has taken: True; allowed is a whole number"),
    ("{message: Doors, signal: Speed, taken: 1, released: 1}", "taken and released of handle_request are both 1"),
    ("{message: Windows, signal: Speed, taken: 1, released: 0}", "no message Windows"),
    ("{message: Doors, signal: Open, taken: 1, released: 0}", "no signal Open"),
    ("{message: Doors, signal: Closed, taken: 2, released: 0}", "Closed of message Doors cannot carry the value 2")])
def test_wrong_output_is_refused_with_a_sentence(tmp_path, entry, words):
    with pytest.raises(ConnectionFailed) as raised:
        load_profile(write(tmp_path, OTHER_PROFILE.replace(*with_handle(entry))))
    assert words in str(raised.value) and "\n" not in str(raised.value)


def test_output_that_switches_the_extender_is_declared_as_that_of_the_handle(tmp_path):
    def profile(entry):
        return write(tmp_path, OTHER_PROFILE.replace("sent_on_change: true", f"extender_switch: {entry}"))

    output = load_profile(profile("{message: Doors, signal: Speed, switched_on: 258, switched_off: 0}")).extender_output
    assert bytes(output.frame(True).data) == bytes(4) + b"\x02\x01" + bytes(2)
    for entry, words in [("{message: Doors}", "table of message, signal, switched_on, switched_off"),
                         ("{message: Doors, signal: Speed, switched_on: 1, switched_off: 1}", "are both 1")]:
        with pytest.raises(ConnectionFailed, match=words):
            load_profile(profile(entry))


def test_extender_is_switched_when_its_frame_has_left_and_is_not_left_on():
    sent, left = [], threading.Event()

    def send(message):
        sent.append(bytes(message.data))
        return left

    extender = BusExtender(DeclaredOutput(1, False, b"\x01", b"\x00"), send)
    assert not extender.is_switched()
    extender.switch(True)
    assert sent == [b"\x01"] and not extender.is_switched()
    left.set()
    assert extender.is_switched()
    extender.release()
    assert sent == [b"\x01"] and not extender.is_switched()
    extender.close()
    extender.close()
    assert sent == [b"\x01", b"\x00"]


def test_extender_that_could_not_be_switched_off_is_when_the_adapter_is_back_and_never_on():
    sent, left = [], []

    def send(message):
        sent.append(bytes(message.data))
        left.append(threading.Event())
        return left[-1]

    extender = BusExtender(DeclaredOutput(1, False, b"\x01", b"\x00"), send)
    extender.reopened()
    extender.switch(True)
    extender.reopened()
    assert sent == [b"\x01"]
    extender.switch(False)
    extender.reopened()
    assert sent == [b"\x01", b"\x00", b"\x00"] and not extender.is_switched()
    left[-1].set()
    extender.reopened()
    assert extender.is_switched() and len(sent) == 3


def test_broken_database_is_refused_with_a_sentence(tmp_path):
    with pytest.raises(ConnectionFailed, match="other.dbc cannot be read"):
        load_profile(write(tmp_path, dbc="BO_ what"))


def test_sentence_about_a_broken_database_does_not_quote_all_of_it(tmp_path):
    with pytest.raises(ConnectionFailed) as error:
        load_profile(write(tmp_path, dbc="BO_ 100 " + "a" * 5000))
    assert len(str(error.value)) < 1000


def test_unknown_profile_names_the_shipped_ones():
    with pytest.raises(ConnectionFailed, match="no car profile my_car; shipped are: .*mtr_demo_car"):
        load_profile("my_car")
