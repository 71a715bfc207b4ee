"""Handle and extender of the honest Car: effects of handle requests and of the host's frames on the locks."""
# SPDX-License-Identifier: Apache-2.0
import cantools
from honest_bench import BESIDE, DOOR, FAR, LOCK_PRESSED

from mtr_simulation.car.can_port import SentFrame
from mtr_simulation.car.ecu import Command
from mtr_simulation.car.honest.frames import DBC_PATH
from mtr_simulation.car.honest.locks import Cause, LockState


def test_handle_car_waits_for_a_hand_and_looks_where_the_key_is(bench):
    bench = bench(passive_entry={"unlock_on": "handle"})
    assert bench.stays(DOOR, 3.0) is LockState.LOCKED
    bench.car.request_handle()
    assert bench.stays(BESIDE, 0.5) is LockState.LOCKED  # too far at the time of the request
    bench.car.request_handle()
    assert bench.stays(DOOR, 0.5) is LockState.UNLOCKED
    assert bench.car.locks.cause is Cause.HANDLE
    bench.car.request_handle(Command.LOCK)
    assert bench.stays(DOOR, 0.5) is LockState.LOCKED
    assert [kind for kind, _ in bench.events()] == ["handle", "handle", "unlocked", "handle", "locked"]
    assert bench.accepted("handle") == ["0", "1", "1"]


def test_actuator_on_the_bus_takes_the_handle_once_each_time(bench):
    bench = bench(passive_entry={"unlock_on": "handle"})
    message = cantools.database.load_file(str(DBC_PATH)).get_message_by_name("HandleActuator")

    def send(order):
        bench.port.from_host.append(SentFrame(message.frame_id, message.encode({"HandleRequest": order})))
        return bench.stays(DOOR, 0.5)

    assert send("released") is LockState.LOCKED
    assert send("open") is LockState.UNLOCKED and bench.car.locks.cause is Cause.HANDLE
    bench.presses(DOOR, LOCK_PRESSED)
    assert send("open") is LockState.LOCKED  # not released in between
    assert send("released") is LockState.LOCKED
    assert send("open") is LockState.UNLOCKED
    assert send("lock") is LockState.LOCKED


def test_other_and_damaged_frames_of_the_host_take_no_handle(bench):
    bench = bench(passive_entry={"unlock_on": "handle"})
    bench.port.from_host += [SentFrame(1200, b"\x01"), SentFrame(1201, b""), SentFrame(1201, b"\x03")]
    assert bench.stays(DOOR, 0.5) is LockState.LOCKED
    assert not bench.frames("HandleActuator")


def test_extender_brings_the_field_to_a_key_that_is_far_only_while_it_is_on(bench):
    bench = bench(passive_entry={"unlock_on": "handle", "extender_db": 60.0}, noise={"lapse": 0.0})
    message = cantools.database.load_file(str(DBC_PATH)).get_message_by_name("ExtenderSwitch")

    def request(*data):
        bench.port.from_host += [SentFrame(message.frame_id, each) for each in data]
        bench.car.request_handle()
        return bench.stays(BESIDE, 0.5)

    assert request() is LockState.LOCKED
    # A damaged frame changes nothing.
    assert request(b"\x01", b"\x00", b"") is LockState.LOCKED
    assert request(b"\x01", b"") is LockState.UNLOCKED and bench.car.locks.cause is Cause.HANDLE


def test_hand_that_comes_by_itself_unlocks_near_the_door_only(bench):
    bench = bench(passive_entry={"unlock_on": "handle", "handle_period_s": 1.0})
    assert bench.stays(FAR, 3.0) is LockState.LOCKED
    assert bench.stays(DOOR, 1.5) is LockState.UNLOCKED
