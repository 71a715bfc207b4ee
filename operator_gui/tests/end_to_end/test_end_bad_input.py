"""Whatever is wrong at the start is one sentence and exit code 2; nothing is written, and the robot does not move."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import pty
import socket
import threading
import tty

import pytest

from mtr_operator.car_link.profile import PROFILE_FOLDER


@pytest.fixture
def refused(laptop, capsys):
    """refused(...) runs into an error; the sentence, after the checks that hold for all of them."""
    def run(*extra, **changes):
        before = sorted(laptop.folder.rglob("*"))
        assert laptop.run(*extra, **changes) == 2
        *notice, sentence = capsys.readouterr().err.splitlines()
        assert sentence.endswith(".")
        assert not any(line.startswith("Traceback") for line in notice)
        assert sorted(laptop.folder.rglob("*")) == before
        assert laptop.look().waypoint_id == 0
        return sentence
    return run


@pytest.fixture
def file(laptop):
    """file(name, text) writes a file and returns its path."""
    def write(name, text):
        path = laptop.folder / name
        path.write_text(text, encoding="utf-8")
        return path
    return write


@pytest.mark.parametrize(("text", "part"), [
    ("maximum_speed_mps: 5\n", "maximum_speed_mps is 5 m/s; allowed is 0.05 to 2 m/s."),
    ("minimum_distance_m: 3\nmaximum_distance_m: 2\n", "minimum_distance_m is 3 m; it has to be below"),
    ("speed: 1\n", "speed is unknown"), ("maximum_distance_m: [\n", "not valid YAML"),
    ("maximum_distance_m: 1e999\n", "allowed is")])
def test_bad_parameters(refused, file, text, part):
    assert part in refused("--simulated-car", params=file("bad.yaml", text))


@pytest.mark.parametrize(("changes", "part"), [
    ({"robot": "300.1.1.1"}, "300.1.1.1; an IPv4 address is four numbers from 0 to 255"),
    ({"robot": "robot.invalid"}, "robot.invalid"),
    ({"subscriber_port": 0}, "subscriber port is 0; allowed is a whole number from 1 to 65535"),
    ({"publisher_port": 70000}, "publisher port is 70000; allowed is"),
    ({"can_interface": "tin"}, "'tin'; allowed are"),
    ({"can_interface": "virtual", "can_bitrate": 5}, "bit rate is 5; allowed is 10000 to 1000000"),
    ({"can_interface": "slcan", "can_channel": "/dev/no_such_adapter"}, "no CAN adapter at /dev/no_such_adapter"),
    ({"can_interface": "slcan", "can_channel": __file__}, "is no serial port"),
    ({"can_interface": "virtual", "car_profile": "no_such_car"}, "no_such_car; shipped are: mtr_demo_car"),
])
def test_bad_connection_settings(refused, changes, part):
    car = () if "can_interface" in changes else ("--simulated-car",)
    assert part in refused(*car, **changes)


def test_port_on_which_nothing_listens(refused):
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))
        port = closed.getsockname()[1]
        assert f"Nothing listens on publisher port {port}" in refused("--simulated-car", publisher_port=port)


def test_swapped_ports(refused, laptop):
    ports = {"subscriber_port": laptop.server.publisher_port, "publisher_port": laptop.server.subscriber_port}
    assert "may be swapped" in refused("--simulated-car", **ports)


@pytest.mark.parametrize(("replaced", "part"), [
    (("mtr_demo_car.dbc", "lost.dbc"), "lost.dbc cannot be read"),
    (("signal: LockState", "signal: Doors"), "has no signal Doors"),
    (("message: DoorLockStatus", "message: Doors"), "has no message Doors")])
def test_database_that_does_not_fit_the_profile(refused, file, replaced, part):
    file("mtr_demo_car.dbc", (PROFILE_FOLDER / "mtr_demo_car.dbc").read_text(encoding="utf-8"))
    profile = file("car.yaml", (PROFILE_FOLDER / "mtr_demo_car.yaml").read_text(encoding="utf-8").replace(*replaced))
    assert part in refused(car_profile=profile, can_interface="virtual")


def test_broken_database(refused, file):
    file("mtr_demo_car.dbc", (PROFILE_FOLDER / "mtr_demo_car.dbc").read_text(encoding="utf-8")[:300])
    profile = file("car.yaml", (PROFILE_FOLDER / "mtr_demo_car.yaml").read_text(encoding="utf-8"))
    sentence = refused(car_profile=profile, can_interface="virtual")
    assert "has no message DoorLockStatus; not all of it could be read: " in sentence and "line 20" in sentence


@pytest.fixture
def terminal():
    """Pseudo-terminal: (master, path of the slave)."""
    master, slave = pty.openpty()
    tty.setraw(slave)
    yield master, os.ttyname(slave)
    os.close(slave)
    os.close(master)


def test_mute_adapter(refused, terminal):
    assert "does not answer" in refused(can_interface="slcan", can_channel=terminal[1])


def test_adapter_on_a_silent_bus(refused, terminal):
    master, path = terminal

    def answer():
        for command in iter(lambda: os.read(master, 1), b""):
            if command == b"\r":
                os.write(master, b"\r")
            elif command == b"q":
                return
    adapter = threading.Thread(target=answer)
    adapter.start()
    sentence = refused(can_interface="slcan", can_channel=path)
    with open(path, "wb", buffering=0) as end:
        end.write(b"q")
    adapter.join()
    assert "No CAN frame for" in sentence
    assert "check the plug, the bit rate" in sentence


@pytest.mark.parametrize(("text", "part"), [
    ('{"format": "mtr-op', "truncated"), ("{}", "not a progress file"),
    ('{"format": "mtr-operator progress", "version": 9}', "version 9; this application reads version 1"),
    ('{"format": "mtr-operator progress", "version": 1, "scenario": "key_press"}', "scenario key_press")])
def test_progress_file_that_does_not_fit(refused, file, text, part):
    path = file("former.json", text)
    sentence = refused("--simulated-car", "--continue", path)
    assert part in sentence and str(path) in sentence


def test_folder_below_a_file(refused, file):
    out = file("file", "x") / "out"
    assert f"cannot be written to the folder {out}" in refused("--simulated-car", out=out)


@pytest.mark.parametrize("name", ["progress.json", "results.csv", "protocol.png"])
def test_folder_with_results_of_another_test(refused, file, laptop, name):
    file(name, json.dumps({"results": [{"axis": 1}]}))
    assert "of another test" in refused("--simulated-car", out=laptop.folder)


def test_robot_in_other_hands(refused, laptop):
    with_robot = laptop.start("--simulated-car", out=laptop.folder / "first")
    try:
        with_robot.wait_until_said("axis 1")
        assert laptop.run("--simulated-car") == 2
        assert not (laptop.folder / "out").exists()
    finally:
        with_robot.process.terminate()
        assert with_robot.finish()[0] == 130
