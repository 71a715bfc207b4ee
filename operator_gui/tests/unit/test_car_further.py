"""What a Car tells beside its locks: causes, counters, keys and doors of other messages and buses."""
# SPDX-License-Identifier: Apache-2.0
import math
import shutil

import pytest
from further_car import (
    ALIVE,
    CAUSE,
    CAUSE_ID,
    COUNTER,
    DATABASE,
    DOORS,
    DOORS_ID,
    KEY,
    PROFILE,
    STATE_ID,
    STAYING,
    Bench,
    written,
)

from mtr_operator.car_link.bus import CanCarLink
from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.further.companions import Companions
from mtr_operator.car_link.further.cycles import CycleCheck
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.actions.lock_history import Expected, LockHistory
from mtr_operator.domain.actions.trouble import LineInvalid
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import KEY_BUTTON, PASSIVE_ENTRY, CarEvent, LockFacts, LockState


@pytest.fixture(name="bench")
def bench_fixture(tmp_path):
    """Bench of a Car with all that can be declared."""
    return Bench(written(tmp_path, CAUSE, COUNTER, ALIVE, KEY, DOORS))


def test_cause_counter_and_key_come_from_another_message(bench):
    event = bench.change(1, why=2)
    assert (event.source, event.doubt, event.cause_raw, event.key_number) == (KEY_BUTTON, "", "", 3)
    assert bench.change(0, why=1).source == PASSIVE_ENTRY


def test_change_waits_until_all_is_known_of_it_and_has_its_own_time(bench):
    changed_s = bench.now_s
    bench.lock, bench.why, bench.count = 1, 1, 1
    bench.run(0.4)
    assert bench.events == []
    bench.why = 0
    bench.run(0.4)
    event, = bench.events
    assert event.time_s == pytest.approx(changed_s + 0.05, abs=0.06)


def test_value_that_is_not_listed_is_shown_raw(bench):
    event = bench.change(1, why=9)
    assert (event.source, event.cause_raw, event.doubt) == ("", "Why = 9", "")


def test_change_without_a_cause_has_none(bench):
    event = bench.change(1)
    assert (event.source, event.cause_raw, event.doubt) == ("", "", "")


@pytest.mark.parametrize(("change", "words"), [
    ({"why": 1, "count": 0}, "Events counted nothing"), ({"why": 1, "key": 5}, "key with the number 5"),
    ({"why": 1, "count": 2}, "The signal Events of the Car's message Cause went from 0 to 2")])
def test_what_contradicts_a_change_is_its_doubt(bench, change, words):
    bench.lock, bench.why, bench.key = 1, change["why"], change.get("key", 3)
    bench.count += change.get("count", 1)
    bench.run(1.5)
    assert any(words in event.doubt for event in bench.events)


@pytest.mark.parametrize(("lines", "words"), [
    ((KEY,), "did not say which key moved its locks, and number 3 is under test"),
    ((COUNTER,), "Events was silent"), ((CAUSE, COUNTER, ALIVE, KEY), "did not say which key")])
def test_message_that_has_fallen_silent_vouches_for_no_change(tmp_path, monkeypatch, lines, words):
    bench, send = Bench(written(tmp_path, *lines)), LockWatch.frame
    assert bench.change(1).doubt == ""
    monkeypatch.setattr(LockWatch, "frame",
                        lambda watch, frame: None if frame.can_id == CAUSE_ID else send(watch, frame))
    bench.run(5.0)
    assert words in bench.change(0, key=5).doubt
    monkeypatch.undo()
    bench.run(1.0)
    assert bench.change(1).doubt == ""


@pytest.mark.parametrize("late_s", [-0.4, 0.4])
def test_message_that_comes_once_about_a_change_vouches_for_it(tmp_path, monkeypatch, late_s):
    bench, send = Bench(written(tmp_path, COUNTER, KEY)), LockWatch.frame
    told_s = bench.now_s + 1.0 + late_s
    monkeypatch.setattr(LockWatch, "frame", lambda watch, frame: send(watch, frame) if frame.can_id == STATE_ID
                        or abs(frame.arrival_s - told_s) < 0.03 else None)
    bench.count += 1
    bench.run(1.0)
    event = bench.change(1, count=0)
    assert (event.doubt, event.key_number) == ("", 3)


def test_key_that_is_not_told_is_none_where_any_may_be_tested(tmp_path, monkeypatch):
    bench, send = Bench(written(tmp_path, KEY.replace(", under_test: 3", ""))), LockWatch.frame
    monkeypatch.setattr(LockWatch, "frame",
                        lambda watch, frame: None if frame.can_id == CAUSE_ID else send(watch, frame))
    bench.run(5.0)
    event = bench.change(1)
    assert (event.doubt, event.key_number) == ("", None)


def test_two_causes_of_one_change_contradict_each_other(bench):
    bench.lock, bench.count, bench.why = 1, 1, 1
    bench.run(0.1)
    bench.why = 2
    bench.run(1.5)
    assert "two causes of one change" in bench.events[0].doubt


def test_counter_of_frames_of_another_message_that_stands_still_is_a_doubt(bench):
    bench.is_alive_counting = False
    bench.run(1.0)
    assert bench.events and "The signal Alive of the Car's message Cause stands still" in bench.events[0].doubt


def test_door_that_is_opened_is_told_and_doubts_a_change(bench):
    bench.doors = 2
    bench.run(1.0)
    told, = bench.events
    assert "passenger is open" in told.doubt
    assert "while passenger was open" in bench.change(1, why=1).doubt
    bench.doors = 0
    assert bench.change(0, why=1).doubt == ""


def test_cause_that_stays_belongs_to_the_change_before_it(tmp_path):
    bench = Bench(written(tmp_path, STAYING))
    bench.why = 1
    bench.run(2.0)
    # What stands there still is of the change before.
    bench.lock = 1
    bench.run(0.1)
    bench.why = 2
    bench.run(1.5)
    assert bench.events[-1].source == KEY_BUTTON


def test_drivers_door_only_is_unlocked_and_named(tmp_path):
    bench = Bench(written(tmp_path))
    event = bench.change(2)
    assert (event.lock_state, event.doors) == (LockState.UNLOCKED, "driver")
    bench.lock = 1
    bench.run(1.0)
    assert len(bench.events) == 1 and bench.watch.lock_state is LockState.UNLOCKED


def test_multiplexed_signal_on_another_page_is_named(tmp_path):
    bench = Bench(written(tmp_path))
    assert bench.watch.problem == ""
    bench.page = 0
    # The silence is measured on the laptop's clock, too.
    bench.run(1.5)
    assert ("Message State (id 0x120) comes without the signal Lock: another page of a multiplexed message" in
            bench.watch.problem)


def test_state_of_all_doors_together(tmp_path):
    signal = "signal: {driver: Driver, passenger: Passenger}"
    of_doors = PROFILE.replace("signal: Lock", signal).replace("message: State", "message: Doors")
    path = written(tmp_path, profile=of_doors)
    profile = load_profile(path)
    readings = [profile.decode(DOORS_ID, False, bytes([raw])) for raw in range(4)]
    assert [reading.state for reading in readings] == [LockState.LOCKED] + 3 * [LockState.UNLOCKED]
    assert [reading.doors for reading in readings] == ["", "driver", "passenger", ""]
    mixed = written(tmp_path, profile=of_doors.replace("1: unlocked, ", ""))
    assert load_profile(mixed).decode(DOORS_ID, False, b"\1").state is LockState.UNKNOWN


@pytest.mark.parametrize(("lines", "words"), [
    ("causes: {signal: Why}\n", "causes must be a list of tables"),
    ("causes: [{message: Cause, sources: {1: key_button}}]\n", "causes must be a table of"),
    ("causes: [{message: Cause, signal: Why, sources: {1: wind}}]\n", "sources has 1: 'wind'"),
    ("causes: [{message: Cause, signal: What, sources: {1: handle}}]\n", "Cause of CAN database .* has no signal"),
    ("causes: [{message: Cause, signal: Why, sources: {1: handle}, idle: no}]\n", "allowed is a list of"),
    ("causes: [{bus: body, message: Cause, signal: Why, sources: {1: handle}}]\n", "the bus body, which is not in"),
    ("buses: {body: car.dbc}\ndoors: {left: {bus: body, signal: Driver}}\n", "is on the bus body and names no message"),
    ("buses: [body]\n", "buses must be a table"), ("doors: [left]\n", "doors must be a table"),
    ("buses: {body: none.dbc}\ndoors: {left: {bus: body, message: Doors, signal: Driver}}\n", "none.dbc cannot be"),
    ("key_number: {message: Cause, signal: Key, under_test: first}\n", "key_number has under_test: 'first'"),
    ("cause_within_s: 60\n", "cause_within_s is 60; allowed is 0 to 10 s"),
    ("uds_poll: {request_id: 1}\n", "must be a table of .*; needed are data_identifier, request_id, response_id"),
    ("uds_poll: {request_id: 1, response_id: 2048, data_identifier: 1}\n", "response_id: 2048; allowed is 0 to 0x7ff"),
    ("uds_poll: {request_id: 1, response_id: 2, data_identifier: 1, every_s: 0}\n", "every_s is 0; allowed is 0.05")])
def test_wrong_entry_is_a_sentence(tmp_path, lines, words):
    with pytest.raises(ConnectionFailed, match=words):
        load_profile(written(tmp_path, lines))


@pytest.mark.parametrize("name", ["lock.sym", "lock.kcd", "lock.arxml"])
def test_databases_of_other_kinds_are_read(tmp_path, name):
    texts = {"lock.sym": SYM, "lock.kcd": KCD, "lock.arxml": ARXML}
    (tmp_path / name).write_text(texts[name])
    path = tmp_path / "car.yaml"
    path.write_text(PROFILE.replace("car.dbc", name))
    profile = load_profile(str(path))
    assert profile.decode(STATE_ID, False, b"\x01\x00").state is LockState.UNLOCKED
    assert profile.decode(STATE_ID, False, b"\x00\x00").state is LockState.LOCKED


SYM = f"""FormatVersion=6.0 // Do not edit this line!
Title="test"
{{SEND}}

[State]
ID={STATE_ID:03X}h
Len=2
Var=Lock unsigned 0,2
"""
KCD = f"""<NetworkDefinition xmlns="http://kayak.2codeornot2code.org/1.0"><Document/>
<Bus name="body"><Message id="0x{STATE_ID:X}" length="2" name="State">
<Signal name="Lock" offset="0" length="2"/></Message></Bus></NetworkDefinition>
"""
ARXML = f"""<?xml version="1.0" encoding="UTF-8"?>
<AUTOSAR xmlns="http://autosar.org/schema/r4.0"><AR-PACKAGES><AR-PACKAGE><SHORT-NAME>P</SHORT-NAME><ELEMENTS>
<CAN-CLUSTER><SHORT-NAME>C</SHORT-NAME><CAN-CLUSTER-VARIANTS><CAN-CLUSTER-CONDITIONAL><PHYSICAL-CHANNELS>
<CAN-PHYSICAL-CHANNEL><SHORT-NAME>H</SHORT-NAME><FRAME-TRIGGERINGS><CAN-FRAME-TRIGGERING><SHORT-NAME>T</SHORT-NAME>
<FRAME-REF DEST="CAN-FRAME">/P/State</FRAME-REF><CAN-ADDRESSING-MODE>STANDARD</CAN-ADDRESSING-MODE>
<IDENTIFIER>{STATE_ID}</IDENTIFIER></CAN-FRAME-TRIGGERING></FRAME-TRIGGERINGS></CAN-PHYSICAL-CHANNEL>
</PHYSICAL-CHANNELS></CAN-CLUSTER-CONDITIONAL></CAN-CLUSTER-VARIANTS></CAN-CLUSTER>
<CAN-FRAME><SHORT-NAME>State</SHORT-NAME><FRAME-LENGTH>2</FRAME-LENGTH><PDU-TO-FRAME-MAPPINGS><PDU-TO-FRAME-MAPPING>
<SHORT-NAME>M</SHORT-NAME><PACKING-BYTE-ORDER>MOST-SIGNIFICANT-BYTE-LAST</PACKING-BYTE-ORDER>
<PDU-REF DEST="I-SIGNAL-I-PDU">/P/U</PDU-REF><START-POSITION>0</START-POSITION></PDU-TO-FRAME-MAPPING>
</PDU-TO-FRAME-MAPPINGS></CAN-FRAME>
<I-SIGNAL-I-PDU><SHORT-NAME>U</SHORT-NAME><LENGTH>2</LENGTH><I-SIGNAL-TO-PDU-MAPPINGS><I-SIGNAL-TO-I-PDU-MAPPING>
<SHORT-NAME>L</SHORT-NAME><I-SIGNAL-REF DEST="I-SIGNAL">/P/Lock</I-SIGNAL-REF>
<PACKING-BYTE-ORDER>MOST-SIGNIFICANT-BYTE-LAST</PACKING-BYTE-ORDER><START-POSITION>0</START-POSITION>
</I-SIGNAL-TO-I-PDU-MAPPING></I-SIGNAL-TO-PDU-MAPPINGS></I-SIGNAL-I-PDU>
<I-SIGNAL><SHORT-NAME>Lock</SHORT-NAME><LENGTH>2</LENGTH>
<SYSTEM-SIGNAL-REF DEST="SYSTEM-SIGNAL">/P/S</SYSTEM-SIGNAL-REF>
</I-SIGNAL><SYSTEM-SIGNAL><SHORT-NAME>S</SHORT-NAME></SYSTEM-SIGNAL></ELEMENTS></AR-PACKAGE></AR-PACKAGES></AUTOSAR>
"""


def test_names_that_the_format_forbids_are_read_nevertheless(tmp_path):
    path = written(tmp_path)
    forbidden = DATABASE.replace("Doors: 1", "2017_5: 1") + f'\nVAL_ {DOORS_ID} Driver 0 "closed"\n'
    (tmp_path / "car.dbc").write_text(forbidden)
    profile = load_profile(path)
    assert profile.message_names[DOORS_ID, False] == "_2017_5"


def test_databases_may_be_in_another_folder(tmp_path):
    path = written(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    shutil.move(tmp_path / "car.dbc", tmp_path / "elsewhere")
    with pytest.raises(ConnectionFailed, match=r"car\.dbc cannot be read"):
        load_profile(path)
    assert load_profile(path, tmp_path / "elsewhere").message.name == "State"


def test_car_that_is_asked_needs_an_adapter_that_may_ask(tmp_path):
    poll = "uds_poll: {request_id: 0x7A0, response_id: 0x7A8, data_identifier: 0x1234}\n"
    path = tmp_path / "asked.yaml"
    path.write_text(poll + "states: {0: locked, 1: unlocked}\n")
    car = CanCarLink("virtual", f"{tmp_path}", profile=str(path))
    with pytest.raises(ConnectionFailed, match=r"asks the Car for its lock state .* only listens; choose normal mode"):
        car.connect()


def event_of(source="", raw=""):
    """An unlock."""
    return CarEvent(5.0, 0.01, LockState.UNLOCKED, source, cause_raw=raw)


@pytest.mark.parametrize(("facts", "event", "words"), [
    (LockFacts(frozenset({PASSIVE_ENTRY})), event_of(raw="Why = 9"), r"does not list \(Why = 9\), not by the key"),
    (LockFacts(frozenset({KEY_BUTTON}), needs_source=True), event_of(raw="Why = 9"), r"does not list \(Why = 9\)"),
    (LockFacts(frozenset({KEY_BUTTON}), needs_source=True), event_of(), "that its profile does not list, not by")])
def test_line_whose_change_has_no_listed_cause_is_invalid(facts, event, words):
    history = LockHistory(LockState.LOCKED, facts)
    history.expect(Expected(LockState.UNLOCKED, PASSIVE_ENTRY, "the key", 0.0))
    with pytest.raises(LineInvalid, match=words):
        history.take(event)


def test_cause_that_is_not_required_may_be_unknown():
    history = LockHistory(LockState.LOCKED, LockFacts(frozenset({KEY_BUTTON})))
    history.expect(Expected(LockState.UNLOCKED, PASSIVE_ENTRY, "the key", 0.0))
    history.take(event_of())
    assert history.answer is not None


@pytest.mark.parametrize(("period_s", "words"), [
    (0.1, ()), (0.13, ()), (0.5, ("Message State comes every 0.5 s, and cycle_time_s of the car profile says 0.1 s",)),
    (0.02, ("Message State comes every 0.02 s",))])
def test_cycle_of_the_bus_is_compared_with_the_profiles(tmp_path, period_s, words):
    check = CycleCheck(load_profile(written(tmp_path, CAUSE)))
    for index in range(30):
        check.frame(CanFrame(STATE_ID, False, bytes(2), 0.01 * index), period_s * index)
        check.frame(CanFrame(CAUSE_ID, False, bytes(2), 0.01 * index), 0.05 * index)
    assert len(check.notices) == len(words)
    assert all(word in notice for word, notice in zip(words, check.notices))


def test_cycle_that_the_database_tells_is_compared_too(tmp_path):
    check = CycleCheck(load_profile(written(tmp_path, CAUSE)))
    for index in range(30):
        check.frame(CanFrame(CAUSE_ID, False, bytes(2), 0.01 * index), 0.2 * index)
    notice, = check.notices
    assert "Message Cause comes every 0.2 s, and its database says 0.05 s" in notice
    assert CycleCheck().notices == ()


def test_frames_that_are_too_short_say_nothing(tmp_path):
    companions = Companions(load_profile(written(tmp_path, CAUSE)).further)
    assert companions.frame(("", CAUSE_ID, False), b"", 1.0) == []
    assert companions.told(1.0) == ("", "", None, "")
    assert math.isfinite(load_profile(written(tmp_path, CAUSE)).facts.settles_s)
