"""What is wrong with adapter or bus is told within half a second, by each driver's own words, and disturbs nothing."""
# SPDX-License-Identifier: Apache-2.0
import can
import pytest

from mtr_operator.car_link.adapter import AdapterSettings
from mtr_operator.car_link.bus_trouble import BusTrouble
from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.clocks.frame_time import FrameTime
from mtr_operator.car_link.clocks.stamp_kind import StampKind
from mtr_operator.car_link.drivers.health import LOOK_PERIOD_S, AdapterHealth
from mtr_operator.car_link.reader import _POLL_S
from mtr_operator.car_link.traffic import TrafficMeter
from mtr_operator.domain.robot_status import RobotStatus


class Sink:
    def __init__(self):
        self.said, self.errors, self.lost = [], 0, 0

    def error_frame(self):
        self.errors += 1

    def frames_lost(self):
        self.lost += 1

    def fault(self, text):
        self.said.append(text)


class Driver:
    """A bus of any driver; state, status, overruns: what it says when it is asked."""

    def __init__(self):
        self.state, self.code, self.overruns = can.BusState.ACTIVE, 0, 0

    def status(self):
        return self.code

    def get_stats(self):
        return self


def looked(interface, *changes):
    """The sink after a look at each of the changes of a driver."""
    sink, driver = Sink(), Driver()
    health = AdapterHealth(interface, sink)
    for number, change in enumerate(({}, *changes)):
        for name, value in change.items():
            setattr(driver, name, value)
        health.look(driver, number * LOOK_PERIOD_S)
    return sink


def test_driver_is_asked_often_enough_for_half_a_second():
    # Once more for adapters that answer later, and the Status of a tenth of a second that shows it.
    assert LOOK_PERIOD_S + 2 * _POLL_S + 0.1 <= 0.5


def test_driver_is_not_asked_at_every_frame():
    sink, driver = Sink(), Driver()
    health = AdapterHealth("pcan", sink)
    health.look(driver, 0.0)
    driver.code = 0x10
    health.look(driver, LOOK_PERIOD_S / 2)
    assert sink.said == []
    health.look(driver, LOOK_PERIOD_S)
    assert len(sink.said) == 1


@pytest.mark.parametrize(("interface", "bad", "good", "word"), [
    ("pcan", {"code": 0x10}, {"code": 0}, "bus-off"), ("pcan", {"code": 0x40000}, {"code": 0}, "error-passive"),
    ("kvaser", {"state": can.BusState.ERROR}, {"state": can.BusState.ACTIVE}, "bus-off"),
    ("vector", {"state": can.BusState.ERROR}, {"state": can.BusState.PASSIVE}, "bus-off")])
def test_trouble_lasts_as_long_as_the_driver_says_it(interface, bad, good, word):
    sink = looked(interface, bad, bad, good)
    assert len(sink.said) == 2 and word in sink.said[0] and sink.said[1] == ""


@pytest.mark.parametrize(("interface", "change"), [
    ("pcan", {"code": 0x02}), ("pcan", {"code": 0x40}), ("kvaser", {"overruns": 7})])
def test_lost_frames_are_told(interface, change):
    assert looked(interface, change).lost == 1


def kernel_frame(classes, data=bytes(8)):
    return can.Message(arbitration_id=classes, data=data, is_error_frame=True, dlc=8)


def test_kernel_tells_its_controllers_state_by_error_frames():
    sink = Sink()
    health = AdapterHealth("socketcan", sink)
    health.error_frame(kernel_frame(0x004, bytes([0, 0x10, 0, 0, 0, 0, 0, 0])))
    health.error_frame(kernel_frame(0x040))
    health.error_frame(kernel_frame(0x100))
    assert ["error-passive" in sink.said[0], "bus-off" in sink.said[1], sink.said[2]] == [True, True, ""]
    assert sink.errors == 0
    health.error_frame(kernel_frame(0x040))
    health.frame()
    assert sink.said[-1] == ""
    health.error_frame(kernel_frame(0x004, bytes([0, 0x01, 0, 0, 0, 0, 0, 0])))
    assert sink.lost == 1
    health.error_frame(kernel_frame(0x008))
    assert sink.errors == 1


def test_error_frames_without_a_frame_are_a_wrong_bit_rate_at_once():
    trouble = BusTrouble(AdapterSettings("virtual", "0", 250_000))
    trouble.error_frame()
    assert "at 250000 bit/s: the bit rate is another one" in trouble.problem
    trouble.frame(CanFrame(1, False, b"", 0.0))
    assert "has errors (1 error frames)" in trouble.problem


def test_error_and_lost_frame_count_for_a_second_of_robot_time():
    for raised in ("error_frame", "frames_lost"):
        trouble = BusTrouble(AdapterSettings("virtual", "0"))
        trouble.status(5.0)
        assert trouble.problem == ""
        getattr(trouble, raised)()
        assert trouble.problem
        trouble.status(5.1)
        trouble.status(6.0)
        assert trouble.problem
        trouble.status(6.11)
        assert trouble.problem == ""


def test_fd_frame_on_a_classic_adapter_is_told():
    trouble = BusTrouble(AdapterSettings("virtual", "0"))
    trouble.frame(CanFrame(1, False, bytes(12), 0.0, is_fd=True))
    assert "CAN FD frames, and the adapter was opened for classic CAN" in trouble.problem
    trouble = BusTrouble(AdapterSettings("virtual", "0", data_bitrate_bps=2_000_000))
    trouble.frame(CanFrame(1, False, bytes(12), 0.0, is_fd=True))
    assert trouble.problem == ""


def test_stamp_of_a_frame_is_said_with_its_uncertainty():
    assert CanFrame(1, False, b"", 0.0).stamps is StampKind.ARRIVAL
    assert CanFrame(1, False, b"", 0.0, stamp_ms=5).stamps is StampKind.ADAPTER
    assert StampKind.KERNEL.text == "the kernel's clock, 1 sigma 1 ms"
    assert StampKind.ADAPTER.sigma_s < StampKind.KERNEL.sigma_s < StampKind.ARRIVAL.sigma_s


@pytest.mark.parametrize("kind", list(StampKind))
def test_stamps_uncertainty_is_part_of_that_of_an_event(kind):
    frames = FrameTime()
    frames.begin(CanFrame(1, False, b"", 0.0))
    for number in range(40):
        time_s = 0.1 * number
        frames.frame(CanFrame(1, False, b"", time_s, kind=kind))
        frames.status(RobotStatus(number, 1, time_s, sent_s=time_s, steady_s=time_s), time_s)
    assert frames.stamps is kind
    assert frames.sigma_with(0.0) ** 2 == pytest.approx(0.003 ** 2 + kind.sigma_s ** 2)


def test_fd_frames_load_the_bus_for_the_time_that_they_take():
    meter = TrafficMeter(500_000, 2_000_000)
    for index in range(4001):
        meter.frame(CanFrame(0x100, False, bytes(64), index * 0.001, is_fd=True), True)
    # 1000 frames a second of 30 bits at 500 kbit/s and 548 at 2 Mbit/s.
    assert meter.traffic(4.0, 0.1).load == pytest.approx(0.334, abs=0.001)
