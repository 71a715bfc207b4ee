"""A Car on several buses: each has an adapter, which is named where it cannot be used."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import time

import can
import pytest
from further_car import CAUSE, CAUSE_ID, DATABASE, Bench, written

from mtr_operator.car_link.adapter import AdapterSettings
from mtr_operator.car_link.bus import CanCarLink
from mtr_operator.car_link.profile import bus_names, profile_files
from mtr_operator.cli.arguments import argument_parser
from mtr_operator.cli.links import car_link
from mtr_operator.domain.errors import BusRefused, ConnectionFailed, InvalidParameter
from mtr_operator.domain.ports import KEY_BUTTON
from mtr_operator.station.connection import BusChoice, CanChoice, LinkOpener


def test_bundle_takes_the_databases_of_all_buses(tmp_path):
    path = written(tmp_path, "buses: {body: body.dbc}\n")
    assert [each.name for each in profile_files(path)] == ["car.yaml", "car.dbc", "body.dbc"]


def test_bus_without_an_adapter_is_named(tmp_path):
    (tmp_path / "body.dbc").write_text(DATABASE)
    car = CanCarLink("virtual", f"{tmp_path}", profile=written(tmp_path, "buses: {body: body.dbc}\n"))
    with pytest.raises(ConnectionFailed, match=r"needs the bus body, too; name its adapter \(--can-bus body="):
        car.connect()
    car.close()


def test_bus_whose_adapter_cannot_be_opened_is_named(tmp_path):
    further = {"body": AdapterSettings("slcan", f"{tmp_path}/none")}
    car = CanCarLink("virtual", f"{tmp_path}", profile=written(tmp_path, "buses: {body: car.dbc}\n"), further=further)
    with pytest.raises(BusRefused, match="^Further bus body: There is no CAN adapter at") as refused:
        car.connect()
    assert refused.value.bus == "body"


def test_bus_on_the_adapter_of_another_one_is_named(tmp_path):
    further = {name: AdapterSettings("virtual", f"{tmp_path}{name}") for name in ("body", "doors")}
    path = written(tmp_path, "buses: {body: car.dbc, doors: car.dbc}\n")
    for taken in (f"{tmp_path}", f"{tmp_path}body"):
        car = CanCarLink("virtual", f"{tmp_path}", profile=path,
                         further={**further, "doors": AdapterSettings("virtual", taken)})
        with pytest.raises(BusRefused, match="^Further bus doors: The CAN adapter .* is that of another bus already"):
            car.connect()


def frames_heard(car, channel):
    """Of one that is sent on a virtual bus."""
    car.connect()
    with can.Bus(interface="virtual", channel=channel) as bus:
        bus.send(can.Message(arbitration_id=CAUSE_ID, is_extended_id=False, data=bytes(4)))
        give_up_s = time.monotonic() + 10.0
        while not car.frames_received and time.monotonic() < give_up_s:
            time.sleep(0.0)
    car.close()
    return car.frames_received


def test_record_names_the_adapter_of_each_bus(tmp_path):
    further = {name: AdapterSettings("virtual", f"{tmp_path}{name}", 125_000) for name in ("body", "doors")}
    path = written(tmp_path, "buses: {body: car.dbc, doors: car.dbc}\n")
    car = CanCarLink("virtual", f"{tmp_path}", profile=path, further=further)
    car.connect()
    with contextlib.closing(car):
        assert dict(car.record) == {
            "CAN adapter": f"virtual {tmp_path}, 500000 bit/s, listens only",
            "CAN adapter of the bus body": f"virtual {tmp_path}body, 125000 bit/s, listens only",
            "CAN adapter of the bus doors": f"virtual {tmp_path}doors, 125000 bit/s, listens only"}


def test_choice_opens_an_adapter_for_each_bus(tmp_path):
    path = written(tmp_path, "buses: {body: car.dbc}\n")
    assert bus_names(path) == ("body",) and bus_names("mtr_demo_car") == ()
    choice = CanChoice("virtual", f"{tmp_path}", profile=path, further=(BusChoice("body", "virtual", f"{tmp_path}2"),))
    assert choice.places == (("virtual", f"{tmp_path}"), ("virtual", f"{tmp_path}2"))
    car = LinkOpener().car(choice)
    assert frames_heard(car, f"{tmp_path}2") == 1


def test_adapter_of_a_further_bus_that_cannot_be_is_named(tmp_path):
    choice = CanChoice("virtual", f"{tmp_path}", further=(BusChoice("body", "virtual", "2", 0),))
    with pytest.raises(BusRefused, match="^Further bus body: CAN bit rate is 0; allowed is") as refused:
        LinkOpener().car(choice)
    assert refused.value.bus == "body"


def test_cause_of_another_bus_belongs_to_the_change(tmp_path):
    cause = CAUSE.replace("message: Cause", "bus: body, message: Cause")
    bench = Bench(written(tmp_path, "buses: {body: car.dbc}\n", cause))
    bench.lock = 1
    bench.run(0.1)
    bench.send(CAUSE_ID, bytes([0x20, 0, 0, 0]), bus="body")
    bench.run(1.0)
    event, = bench.events
    assert event.source == KEY_BUTTON


def run_options(tmp_path, *further):
    """Options of a run on virtual buses."""
    return argument_parser().parse_args([
        "run", "autolock", "--params", "none", "--out", str(tmp_path), "--can-interface", "virtual", "--can-channel",
        f"{tmp_path}", *further])


def test_command_line_names_the_adapters_of_further_buses(tmp_path):
    path = written(tmp_path, "buses: {body: car.dbc}\n")
    options = run_options(tmp_path, "--car-profile", path, "--can-bus", f"body=virtual:{tmp_path}:b:125000")
    car = car_link(options)
    assert frames_heard(car, f"{tmp_path}:b") == 1


@pytest.mark.parametrize("text", ["body", "body=virtual", "body=virtual:b", "=virtual:b:500000", "body=virtual:b:fast"])
def test_further_bus_that_is_not_complete_is_a_sentence(tmp_path, text):
    with pytest.raises(InvalidParameter, match="--can-bus is .*; allowed is NAME=INTERFACE:CHANNEL:BITRATE"):
        car_link(run_options(tmp_path, "--can-bus", text))
