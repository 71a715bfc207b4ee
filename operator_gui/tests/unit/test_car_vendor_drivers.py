"""python-can's own drivers of PCAN and IXXAT over stand-ins for the vendors' libraries: they listen from the start."""
# SPDX-License-Identifier: Apache-2.0

import ctypes
import importlib
import sys

import can.ctypesutil
import pytest
from can.interfaces.pcan import pcan
from can.interfaces.pcan.basic import PCAN_CHANNEL_CONDITION, PCAN_ERROR_OK, PCAN_LISTEN_ONLY, PCAN_PARAMETER_ON

from mtr_operator.car_link.adapter import AdapterSettings, open_adapter, shut_down
from mtr_operator.domain.errors import ConnectionFailed

# Of VCI: bits of its operating modes, and of what an adapter can.
CAN_OPMODE_STANDARD, CAN_OPMODE_LISTONLY, CAN_FEATURE_STDANDEXT = 0x01, 0x08, 0x02


class Vci:
    """IXXAT's library with one adapter; timeout: its error. obeys: the controller takes all that it is ordered to.

    Attributes:
        calls: names, in order. mode: operating mode of the controller. room: frames that wait for their reader.
    """

    def __init__(self, timeout, obeys=True):
        self.calls, self.mode, self.room = [], None, 0
        self._timeout, self._obeys = timeout, obeys

    def __getattr__(self, name):
        return lambda *_: self.calls.append(name)

    def canControlInitialize(self, handle, mode, *rest):
        self.calls.append("canControlInitialize")
        self.mode = mode if self._obeys else mode & ~CAN_OPMODE_LISTONLY

    def canChannelInitialize(self, handle, room, *rest):
        self.room = room

    def canControlGetCaps(self, handle, caps):
        caps._obj.dwFeatures = CAN_FEATURE_STDANDEXT
        caps._obj.dwTscDivisor = 1
        for name in ("dwClockFreq", "dwTscClkFreq"):
            if hasattr(caps._obj, name):
                setattr(caps._obj, name, 1_000_000)

    def canControlGetStatus(self, handle, status):
        status._obj.bOpMode = self.mode

    def canChannelReadMessage(self, *_):
        raise self._timeout


@pytest.fixture(name="vci", params=[("canlib_vcinpl", None), ("canlib_vcinpl2", 2_000_000)],
                ids=["classic", "CAN FD"])
def vci_fixture(request, monkeypatch):
    """Maker of the library, and the data bit rate that chooses it. The driver is for Windows; its types are lent."""
    name, data_bps = request.param
    monkeypatch.setattr(can.ctypesutil, "HRESULT", ctypes.c_long, raising=False)
    package = importlib.import_module("can.interfaces.ixxat")
    driver = importlib.import_module(f"{package.__name__}.{name}")
    exceptions = importlib.import_module(f"{package.__name__}.exceptions")

    def installed(**options):
        library = Vci(exceptions.VCITimeout, **options)
        monkeypatch.setattr(driver, "_canlib", library)
        return library
    return installed, data_bps


def test_ixxat_controller_listens_before_it_is_started(vci):
    installed, data_bps = vci
    library = installed()
    bus = open_adapter(AdapterSettings("ixxat", "0", data_bitrate_bps=data_bps))
    assert library.mode & CAN_OPMODE_LISTONLY and library.mode & CAN_OPMODE_STANDARD
    assert library.room >= 1024
    assert library.calls.index("canControlInitialize") < library.calls.index("canControlStart")
    shut_down(bus)


def test_ixxat_controller_takes_part_on_request_alone_and_the_library_is_left_as_it_was(vci):
    installed, data_bps = vci
    library = installed()
    shut_down(open_adapter(AdapterSettings("ixxat", "0", data_bitrate_bps=data_bps)))
    shut_down(open_adapter(AdapterSettings("ixxat", "0", data_bitrate_bps=data_bps, is_listening=False)))
    assert not library.mode & CAN_OPMODE_LISTONLY


def test_ixxat_controller_that_does_not_obey_is_closed_at_once(vci):
    installed, data_bps = vci
    library = installed(obeys=False)
    with pytest.raises(ConnectionFailed, match="does not take the order to listen only"):
        open_adapter(AdapterSettings("ixxat", "0", data_bitrate_bps=data_bps))
    assert "vciDeviceClose" in library.calls


def test_ixxat_is_refused_where_its_driver_cannot_be_imported(monkeypatch):
    monkeypatch.setitem(sys.modules, "can.interfaces.ixxat", None)
    with pytest.raises(ConnectionFailed, match="^python-can's driver ixxat is for Windows .*socketcan.*$"):
        open_adapter(AdapterSettings("ixxat", "0"))


class PcanBasic:
    """PEAK's library with one adapter. calls: what was asked of it, in order."""

    def __init__(self):
        self.calls, self._listens = [], 0

    def GetValue(self, handle, parameter):
        if parameter == PCAN_LISTEN_ONLY:
            return PCAN_ERROR_OK, self._listens
        return PCAN_ERROR_OK, b"4.8.0.0" if parameter != PCAN_CHANNEL_CONDITION else 1

    def SetValue(self, handle, parameter, value):
        self.calls.append(("set", parameter, value))
        if parameter == PCAN_LISTEN_ONLY:
            self._listens = value
        return PCAN_ERROR_OK

    def Initialize(self, *_):
        self.calls.append(("initialize",))
        return PCAN_ERROR_OK

    InitializeFD = Initialize

    def Uninitialize(self, handle):
        self.calls.append(("uninitialize",))
        return PCAN_ERROR_OK

    Reset = Uninitialize


@pytest.mark.parametrize("data_bps", [None, 2_000_000])
def test_pcan_listens_before_it_is_initialized(monkeypatch, data_bps):
    library = PcanBasic()
    monkeypatch.setattr(pcan, "PCANBasic", lambda: library)
    monkeypatch.setattr(pcan, "HAS_EVENTS", False)
    bus = open_adapter(AdapterSettings("pcan", "PCAN_USBBUS1", data_bitrate_bps=data_bps))
    listens = ("set", PCAN_LISTEN_ONLY, PCAN_PARAMETER_ON)
    assert library.calls.index(listens) < library.calls.index(("initialize",))
    shut_down(bus)
