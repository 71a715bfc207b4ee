"""Body ECU, passive entry, button contact and CAN frames of the simulated Car."""
# SPDX-License-Identifier: Apache-2.0
import cantools
import pytest

from mtr_simulation.car.button import ButtonContact
from mtr_simulation.car.ecu import BodyEcu, Command, LockState, PassiveEntry, Source
from mtr_simulation.car.frames import DBC_PATH, CarFrames
from mtr_simulation.car.parameters import PassiveEntryParameters, RemoteParameters

MS = 1_000_000
START = 1000 * MS
KEY = (1.0, 2.0, 1.0)


@pytest.fixture
def ecu():
    """A booted ECU."""
    ecu = BodyEcu(0)
    ecu.step(START)
    return ecu


@pytest.fixture
def database():
    """The gentle Car's DBC."""
    return cantools.database.load_file(str(DBC_PATH))


def test_ecu_is_unknown_and_deaf_until_it_has_booted():
    ecu = BodyEcu(200 * MS)
    ecu.step(START)
    assert not ecu.command(Command.UNLOCK, Source.KEY_BUTTON, START)
    ecu.step(START + 180 * MS)
    assert ecu.lock_state is LockState.UNKNOWN
    ecu.step(START + 200 * MS)
    assert ecu.lock_state is LockState.LOCKED
    assert ecu.command_counter == 0


def test_command_moves_the_locks_once_and_counts_each_time(ecu):
    assert ecu.command(Command.UNLOCK, Source.PASSIVE_ENTRY, START)
    assert not ecu.command(Command.UNLOCK, Source.KEY_BUTTON, START)
    assert (ecu.lock_state, ecu.last_source, ecu.command_counter) == (LockState.UNLOCKED, Source.KEY_BUTTON, 2)
    assert ecu.command(Command.LOCK, Source.KEY_BUTTON, START)
    assert ecu.lock_state is LockState.LOCKED


def test_passive_entry_unlocks_above_and_locks_below_after_two_polls():
    passive = PassiveEntry(PassiveEntryParameters(unlock_threshold_db=0.0, lock_threshold_db=-12.0))
    strengths = [-20.0, 1.0, 1.0, 1.0, -6.0, -11.9, -13.0, -13.0, -30.0]
    expected = [None, None, Command.UNLOCK, None, None, None, None, Command.LOCK, None]
    assert [passive.poll(strength) for strength in strengths] == expected


def test_passive_entry_ignores_a_single_strong_poll():
    passive = PassiveEntry(PassiveEntryParameters())
    assert [passive.poll(strength) for strength in (1.0, -1.0, 1.0, -1.0)] == [None] * 4


def test_passive_entry_commands_nothing_for_a_key_that_was_never_near():
    passive = PassiveEntry(PassiveEntryParameters())
    assert [passive.poll(-40.0) for _ in range(5)] == [None] * 5


def follow(contact, pulses):
    """Reports of the contact for pulse widths 20 ms apart."""
    return [contact.update(START + 20 * MS * step, pulse, KEY) for step, pulse in enumerate(pulses)]


def test_contact_counts_once_after_80_ms_with_the_time_of_closing():
    reports = follow(ButtonContact(RemoteParameters()), [1000, 1500, 1700, 1900, 2000, 2000, 2000, 2000, 1000])
    assert [report is not None for report in reports] == [False] * 6 + [True, False, False]
    assert reports[6].counts
    assert reports[6].time_ns == START + 40 * MS


def test_contact_of_60_ms_is_reported_but_does_not_count():
    reports = follow(ButtonContact(RemoteParameters()), [1700, 1700, 1700, 1000, 1000])
    assert reports[3].time_ns == START
    assert not reports[3].counts
    assert reports[4] is None


def test_contact_never_closes_below_the_threshold():
    assert follow(ButtonContact(RemoteParameters(contact_travel=0.6)), [1590] * 20) == [None] * 20


def test_frames_lie_7_ms_after_each_tick_and_never_on_one(ecu):
    frames = list(CarFrames(ecu).due(START - 20 * MS, START + 400 * MS))
    lock_frames = [frame for frame in frames if frame.can_id == 800]
    assert [frame.time_ns for frame in lock_frames] == [START + (20 * k - 13) * MS for k in range(21)]
    assert all(frame.time_ns % (20 * MS) == 7 * MS for frame in frames)
    assert sorted(frames, key=lambda frame: (frame.time_ns, frame.can_id)) == frames


def test_frames_split_over_steps_are_those_of_one_long_step(ecu):
    frames = CarFrames(ecu)
    steps = [frame for k in range(20) for frame in frames.due(START + 20 * k * MS, START + 20 * (k + 1) * MS)]
    assert steps == list(frames.due(START, START + 400 * MS))


def test_cycle_times_are_those_of_the_dbc(ecu, database):
    frames = list(CarFrames(ecu).due(START, START + 2000 * MS))
    for message in database.messages:
        count = sum(frame.can_id == message.frame_id for frame in frames)
        assert count == 2000 // message.cycle_time


def test_door_lock_frame_decodes_to_the_state_of_the_ecu(ecu, database):
    ecu.command(Command.UNLOCK, Source.PASSIVE_ENTRY, START)
    frames = [frame for frame in CarFrames(ecu).due(START, START + 200 * MS) if frame.can_id == 800]
    decoded = [database.decode_message(frame.can_id, frame.data) for frame in frames]
    assert {str(d["LockState"]) for d in decoded} == {"unlocked"}
    assert {str(d["LastCommandSource"]) for d in decoded} == {"passive_entry"}
    assert [str(d["LockStateChanged"]) for d in decoded] == ["yes"] * 5 + ["no"] * 5
    alive = [d["AliveCounter"] for d in decoded]
    assert [(b - a) % 16 for a, b in zip(alive, alive[1:])] == [1] * 9


def test_dbc_is_strict_and_names_all_lock_states(database):
    message = database.get_message_by_name("DoorLockStatus")
    assert message.cycle_time == 20
    assert message.length <= 8
    choices = message.get_signal_by_name("LockState").choices
    assert {number: str(name) for number, name in choices.items()} == {
        0: "locked", 1: "unlocked", 2: "unknown", 3: "invalid",
    }  # fmt: skip
