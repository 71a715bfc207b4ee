"""An adapter on a Car's bus only listens unless normal mode is chosen, whatever its driver calls that; CAN FD."""
# SPDX-License-Identifier: Apache-2.0
import json

import can
import pytest
from can.interfaces.pcan.basic import PCAN_ERROR_ILLOPERATION, PCAN_ERROR_OK, PCAN_PARAMETER_OFF, PCAN_PARAMETER_ON

from mtr_operator.car_link import adapter as adapter_module
from mtr_operator.car_link.adapter import AdapterSettings, open_adapter
from mtr_operator.car_link.drivers.kernel_link import KernelLink, check_link, link_of
from mtr_operator.car_link.drivers.options import fd_options, listening_options
from mtr_operator.cli.arguments import argument_parser
from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter
from mtr_operator.station.connection import CanChoice, Connection
from mtr_operator.station.settings import Settings


class OpenedBus:
    """What python-can's Bus was asked for; a PCAN driver that says how it listens, a Vector driver its rights."""

    def __init__(self, listens=(PCAN_ERROR_OK, PCAN_PARAMETER_ON), permission_mask=0b10, **options):
        self.options, self.is_shut_down = options, False
        self.m_objPCANBasic, self.m_PcanHandle, self._listens = self, 0x51, listens
        self.mask, self.permission_mask = 0b10, permission_mask

    def GetValue(self, handle, parameter):
        return self._listens

    def shutdown(self):
        self.is_shut_down = True


@pytest.fixture(name="opened")
def opened_fixture(monkeypatch):
    """Options of the bus opened last; listens: what a PCAN driver says then."""
    opened = {"listens": (PCAN_ERROR_OK, PCAN_PARAMETER_ON), "permission_mask": 0b10}

    def bus(**options):
        opened["bus"] = OpenedBus(opened["listens"], opened["permission_mask"], **options)
        return opened["bus"]
    monkeypatch.setattr(adapter_module.can, "Bus", bus)
    return opened


@pytest.mark.parametrize(("interface", "option", "value"), [
    ("pcan", "state", can.BusState.PASSIVE), ("systec", "state", can.BusState.PASSIVE),
    ("kvaser", "driver_mode", False), ("vector", "listen_only", True), ("nixnet", "listen_only", True),
    ("cantact", "monitor", True), ("seeedstudio", "operation_mode", "silent")])
def test_adapter_is_opened_so_that_it_sends_nothing(opened, interface, option, value):
    open_adapter(AdapterSettings(interface, "0"))
    assert opened["bus"].options[option] == value
    open_adapter(AdapterSettings(interface, "0", is_listening=False))
    assert option not in opened["bus"].options


@pytest.mark.parametrize("interface", ["gs_usb", "socketcand", "usb2can", "neovi"])
def test_driver_that_cannot_only_listen_is_not_opened_before_a_person_says_so(opened, interface):
    words = f"driver {interface} cannot .* only listens; use one of .*pcan.*--can-normal"
    with pytest.raises(ConnectionFailed, match=words):
        open_adapter(AdapterSettings(interface, "0"))
    assert "bus" not in opened
    open_adapter(AdapterSettings(interface, "0", is_listening=False))
    assert "bus" in opened


@pytest.mark.parametrize("answer", [(PCAN_ERROR_OK, PCAN_PARAMETER_OFF), (PCAN_ERROR_ILLOPERATION, PCAN_PARAMETER_ON)])
def test_pcan_adapter_that_does_not_obey_is_closed_at_once(opened, answer):
    opened["listens"] = answer
    with pytest.raises(ConnectionFailed, match="does not take the order to listen only"):
        open_adapter(AdapterSettings("pcan", "PCAN_USBBUS1"))
    assert opened["bus"].is_shut_down


def test_vector_channel_that_another_program_has_set_up_is_closed_at_once(opened):
    opened["permission_mask"] = 0b00
    with pytest.raises(ConnectionFailed, match="end other programs"):
        open_adapter(AdapterSettings("vector", "0"))
    assert opened["bus"].is_shut_down
    open_adapter(AdapterSettings("vector", "0", is_listening=False))


@pytest.mark.parametrize(("wanted_bps", "taken_bps"), [(500_000, 500_000), (83_333, 83_000), (33_333, 33_000)])
def test_pcan_takes_a_rate_by_its_own_name(opened, wanted_bps, taken_bps):
    open_adapter(AdapterSettings("pcan", "PCAN_USBBUS1", wanted_bps))
    assert opened["bus"].options["bitrate"] == taken_bps


@pytest.mark.parametrize("is_listening", [True, False])
def test_rate_that_pcan_would_take_for_500_kbit_is_refused(opened, is_listening):
    with pytest.raises(ConnectionFailed, match="pcan has no bit rate of 62500 bit/s; use one of .*50000, 83000"):
        open_adapter(AdapterSettings("pcan", "PCAN_USBBUS1", 62_500, is_listening=is_listening))
    assert "bus" not in opened


def test_options_of_a_person_go_before_those_of_the_table(opened):
    open_adapter(AdapterSettings("vector", "0", options={"listen_only": False, "app_name": "lab"}))
    assert opened["bus"].options["listen_only"] is False and opened["bus"].options["app_name"] == "lab"


@pytest.mark.parametrize(("interface", "wanted"), [
    ("nixnet", {"fd": True, "fd_bitrate": 2_000_000}), ("virtual", {"protocol": can.CanProtocol.CAN_FD})])
def test_can_fd_is_asked_for_in_the_words_of_the_driver(opened, interface, wanted):
    open_adapter(AdapterSettings(interface, "0", data_bitrate_bps=2_000_000))
    assert wanted.items() <= opened["bus"].options.items()


@pytest.mark.parametrize("interface", ["pcan", "kvaser", "vector"])
@pytest.mark.parametrize("data_bps", [1_000_000, 2_000_000, 4_000_000, 5_000_000])
def test_can_fd_is_given_as_bit_timing_with_the_sample_points_of_cars(interface, data_bps):
    timing = fd_options(interface, 500_000, data_bps)["timing"]
    assert (timing.nom_bitrate, timing.data_bitrate) == (500_000, data_bps)
    assert timing.nom_sample_point == 80.0 and timing.data_sample_point == pytest.approx(80.0, abs=5.1)


def test_driver_without_can_fd_says_so(opened):
    with pytest.raises(ConnectionFailed, match="cantact has no CAN FD; use one of"):
        open_adapter(AdapterSettings("cantact", "0", data_bitrate_bps=2_000_000))
    assert "bus" not in opened


@pytest.mark.parametrize("rate_bps", [250_000, 9_000_000, True])
def test_data_bit_rate_has_limits(rate_bps):
    with pytest.raises(InvalidParameter, match="data bit rate is .* allowed is 500000"):
        AdapterSettings("virtual", "0", data_bitrate_bps=rate_bps)


def told(mode=("LISTEN-ONLY",), rate_bps=500_000, data_bps=None, kind="can"):
    data = {"ctrlmode": list(mode), "bittiming": {"bitrate": rate_bps}}
    if data_bps:
        data["data_bittiming"] = {"bitrate": data_bps}
    return json.dumps([{"ifname": "can0", "linkinfo": {"info_kind": kind, "info_data": data}}])


def test_kernel_tells_how_its_interface_is_opened():
    assert link_of(told(data_bps=2_000_000)) == KernelLink(True, 500_000, 2_000_000)
    assert link_of(told(mode=())) == KernelLink(False, 500_000)
    assert link_of('[{"linkinfo": {"info_kind": "vcan"}}]') == KernelLink(True)


@pytest.mark.parametrize("text", ["", "[]", "{}", '[{"ifname": "eth0"}]', '[{"linkinfo": 5}]', "[5]"])
def test_what_is_no_can_interface_is_not_taken_for_a_silent_one(text):
    with pytest.raises(ConnectionFailed, match="can0 only listens is not known"):
        check_link("can0", 500_000, None, True, lambda _: text)


@pytest.mark.parametrize(("text", "words"), [
    (told(mode=("LOOPBACK",)), "takes part in the bus; .*'ip link set can0 type can bitrate 500000 listen-only on'"),
    (told(rate_bps=250_000), "runs at 250000 bit/s, and 500000 bit/s is chosen"),
    (told(data_bps=5_000_000), "runs at 5000000 bit/s, and 2000000 bit/s is chosen")])
def test_interface_of_the_kernel_that_is_opened_otherwise_is_refused(text, words):
    with pytest.raises(ConnectionFailed, match=words):
        check_link("can0", 500_000, 2_000_000, True, lambda _: text)


def test_in_normal_mode_the_rate_alone_has_to_be_right():
    check_link("can0", 500_000, None, False, lambda _: told(mode=()))
    check_link("can0", 500_000, None, False, lambda _: "nothing")
    with pytest.raises(ConnectionFailed, match="250000"):
        check_link("can0", 500_000, None, False, lambda _: told(mode=(), rate_bps=250_000))


def test_every_driver_that_listens_is_known_to_python_can():
    assert all(listening_options(interface) is not None for interface in ("slcan", "socketcan", "virtual"))
    assert {"slcan", "socketcan", "pcan", "kvaser", "vector"} <= set(can.VALID_INTERFACES)


def test_command_line_listens_unless_told_otherwise():
    arguments = ["run", "autolock", "--params", "p", "--out", "o"]
    options = argument_parser().parse_args(arguments)
    assert not options.can_normal and options.can_data_bitrate is None
    options = argument_parser().parse_args([*arguments, "--can-normal", "--can-data-bitrate", "2000000"])
    assert options.can_normal and options.can_data_bitrate == 2_000_000


def test_normal_mode_is_chosen_anew_at_each_start():
    choice = CanChoice("slcan", "/dev/x", data_bitrate_bps=2_000_000, is_normal=True)
    remembered = Settings().with_connection(Connection(can=choice)).connection.can
    assert not remembered.is_normal and remembered.data_bitrate_bps == 2_000_000
