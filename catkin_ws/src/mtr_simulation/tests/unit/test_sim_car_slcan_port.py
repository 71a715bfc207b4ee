"""CAN adapter on a pseudo-terminal, read by the driver of python-can and by raw bytes."""
# SPDX-License-Identifier: Apache-2.0
import os
import select
import time

import can
import cantools
import pytest

from mtr_core.errors import ConfigurationError
from mtr_simulation.car.can_port import MemoryCanPort
from mtr_simulation.car.car import SimulatedCar
from mtr_simulation.car.frames import DBC_PATH
from mtr_simulation.car.parameters import CarParameters
from mtr_simulation.car.slcan_port import Fault, SlcanPort
from mtr_simulation.truth.log import TruthLog

PATIENCE_S = 10.0  # reached by failing tests only
DATA = bytes([1, 2, 3, 4])


class Host:
    """The host's end of the terminal, byte by byte."""

    def __init__(self, link):
        self._file = os.open(str(link), os.O_RDWR | os.O_NOCTTY)

    def write(self, data):
        """Send bytes to the adapter."""
        os.write(self._file, data)

    def read(self, count):
        """Read exactly count bytes, or fewer if the time-out expires."""
        data = b""
        while len(data) < count and select.select([self._file], [], [], PATIENCE_S)[0]:
            data += os.read(self._file, count - len(data))
        return data

    def ask(self, command, answer):
        """Send a command and check its answer."""
        self.write(command)
        assert self.read(len(answer)) == answer

    def close(self):
        """Close the terminal."""
        os.close(self._file)


@pytest.fixture
def port(tmp_path):
    """An adapter."""
    port = SlcanPort(tmp_path / "adapter" / "can0")
    yield port
    port.close()


@pytest.fixture
def host(port, tmp_path):
    """A host that has opened the channel."""
    host = Host(tmp_path / "adapter" / "can0")
    host.ask(b"S6\rO\r", b"\r\r")
    yield host
    host.close()


def test_python_can_reads_and_cantools_decodes_what_the_car_sends(port, tmp_path):
    database = cantools.database.load_file(str(DBC_PATH))
    memory = MemoryCanPort()
    cars = [SimulatedCar(1, CarParameters(), p, TruthLog(tmp_path / str(i))) for i, p in enumerate((port, memory))]
    with can.Bus(interface="slcan", channel=str(tmp_path / "adapter/can0"), bitrate=500000, sleep_after_open=0) as bus:
        assert bus.get_version(PATIENCE_S) == (10, 13)
        for step in range(50):
            for car in cars:
                car.step(1_000_000_000 + 20_000_000 * step, (0.0, 1.5, 1.0), (1000, 1000))
        received = [bus.recv(PATIENCE_S) for _ in memory.frames]
    assert [(m.arbitration_id, bytes(m.data)) for m in received] == [(f.can_id, f.data) for f in memory.frames]
    states = [database.decode_message(m.arbitration_id, m.data) for m in received if m.arbitration_id == 800]
    assert [str(states[i]["LockState"]) for i in (0, 12, -1)] == ["unknown", "locked", "unlocked"]


def test_stamps_reach_the_host_when_asked_for(port, tmp_path):
    host = Host(tmp_path / "adapter" / "can0")
    host.ask(b"Z1\rS6\rO\r", b"\r\r\r")
    port.send(0x320, DATA, 61_007_000_000)
    assert host.read(18) == b"t32040102030403EF\r"
    host.close()


def test_closed_channel_sends_nothing(port, tmp_path):
    host = Host(tmp_path / "adapter" / "can0")
    port.send(0x320, DATA, 0)
    host.ask(b"V\r", b"V1013\r")
    host.close()


def test_host_that_does_not_read_loses_whole_frames_and_the_simulation_goes_on(port, host):
    sent = 20_000
    for _ in range(sent):
        port.send(0x320, DATA, 0)
    line = b"t320401020304\r"
    assert 0 < port.dropped < sent
    arrived = (sent - port.dropped) * len(line)
    data = host.read(arrived - len(line))
    port.poll()
    data += host.read(arrived - len(data))
    assert data == line * (sent - port.dropped)
    host.ask(b"F\r", b"F08\r")
    port.send(0x123, b"", 0)
    assert host.read(6) == b"t1230\r"


def test_new_host_does_not_read_what_the_last_one_left(port, host, tmp_path):
    for _ in range(10_000):
        port.send(0x320, DATA, 0)
    host.write(b"C\r")
    deadline = time.monotonic() + PATIENCE_S
    while port.adapter.is_open and time.monotonic() < deadline:
        port.poll()
    new = Host(tmp_path / "adapter" / "can0")
    new.ask(b"V\r", b"\rV1013\r")
    new.close()


def test_host_may_hang_up_and_another_one_come(port, tmp_path):
    for _ in range(3):
        host = Host(tmp_path / "adapter" / "can0")
        host.ask(b"V\r", b"V1013\r")
        host.close()


def test_silent_bus_sends_nothing_and_the_adapter_answers(port, host):
    port.fault = Fault.SILENCE
    port.send(0x320, DATA, 0)
    host.ask(b"F\r", b"F00\r")


def test_bus_off_sends_nothing_and_shows_in_the_status_until_it_ends(port, host):
    port.fault = Fault.BUS_OFF
    port.send(0x320, DATA, 0)
    host.ask(b"F\r", b"FA4\r")
    port.fault = Fault.NONE
    host.ask(b"F\r", b"F00\r")
    port.send(0x123, b"", 0)
    assert host.read(6) == b"t1230\r"


def test_garbage_has_the_length_of_the_frame_and_is_none(port, host):
    port.fault = Fault.GARBAGE
    port.send(0x320, DATA, 0)
    assert host.read(14) not in (b"", b"t320401020304\r")
    host.ask(b"F\r", b"F00\r")


def test_garbage_from_the_host_is_answered_and_does_no_harm(port, host):
    host.write(bytes(range(256)) * 4 + b"\r")
    port.send(0x123, b"", 0)
    host.write(b"V\r")
    data = b""
    while not data.endswith(b"V1013\r"):
        byte = host.read(1)
        assert byte
        data += byte
    assert b"t1230\r" in data


def test_link_is_replaced_when_it_is_old_and_removed_at_the_end(tmp_path):
    link = tmp_path / "can0"
    link.symlink_to("/nonexistent")
    port = SlcanPort(link)
    assert os.path.exists(link)
    port.close()
    port.close()
    port.send(0x320, DATA, 0)
    port.poll()
    assert not os.path.lexists(link)


def test_link_of_a_successor_is_left_alone(tmp_path):
    link = tmp_path / "can0"
    first, second = SlcanPort(link), SlcanPort(link)
    first.close()
    assert os.path.exists(link)
    second.close()


def test_link_over_a_file_is_refused_and_the_file_stays(tmp_path):
    path = tmp_path / "can0"
    path.write_text("mine", encoding="utf-8")
    with pytest.raises(ConfigurationError, match="is taken by a file"):
        SlcanPort(path)
    assert path.read_text(encoding="utf-8") == "mine"


def test_link_below_a_file_is_refused_with_the_reason(tmp_path):
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(ConfigurationError, match="cannot be made"):
        SlcanPort(tmp_path / "file" / "can0")


def test_frame_of_the_host_is_taken_once(port, host):
    host.ask(b"t4B1101\r", b"z\r")
    assert port.taken() == [(0x4B1, b"\x01")]
    assert port.taken() == []
