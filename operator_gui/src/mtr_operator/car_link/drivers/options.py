"""Options of python-can's drivers for adapters that only listen, and for CAN FD.

An adapter that listens sends nothing: no frame, no acknowledge and no error flag. Source: the drivers of python-can
4.6. Tested: slcan and the virtual bus, and PCAN and IXXAT with substitutes of their libraries.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Callable, Mapping

import can

SLCAN, PCAN, SOCKETCAN, VECTOR, IXXAT = "slcan", "pcan", "socketcan", "vector", "ixxat"
_LISTENING: Mapping[str, Mapping[str, Any]] = {
    SLCAN: {"listen_only": True},
    PCAN: {"state": can.BusState.PASSIVE},
    "kvaser": {"driver_mode": False},  # its name for silent, DRIVER_MODE_SILENT
    VECTOR: {"listen_only": True},
    # The controller mode is set in drivers/ixxat.py.
    IXXAT: {},
    "systec": {"state": can.BusState.PASSIVE},
    "nixnet": {"listen_only": True},
    "cantact": {"monitor": True},
    "seeedstudio": {"operation_mode": "silent"},
    # The kernel opens the adapter; kernel_link checks the mode.
    SOCKETCAN: {},
    # These have neither wire nor acknowledge.
    "virtual": {},
    "udp_multicast": {}}
_FD_CLOCK_HZ = 80_000_000
# CiA 601-3: both sample points at 80 % for such clocks.
_SAMPLE_POINT_PERCENT = 80.0
# PCAN calls 83.333, 47.619, 33.333 and 95.238 kbit/s 83, 47, 33 and 95; its other names are exact.
_SAME_RATE = 0.015


class Unsupported(Exception):
    """The driver does not support it; the text is a sentence."""


def listening_options(interface: str) -> dict[str, Any]:
    """Return the options of an adapter that only listens; Unsupported if the driver has no such mode."""
    if interface not in _LISTENING:
        raise Unsupported(f"python-can's driver {interface} cannot open an adapter so that it only listens; use one of "
                          f"{', '.join(sorted(_LISTENING))}, or choose normal mode (--can-normal) for a bench of one "
                          "node.")
    return dict(_LISTENING[interface])


def rate_of(interface: str, bitrate_bps: int) -> int:
    """Return the bit rate as named by the driver; Unsupported if it lacks the rate and would silently use another
    one."""
    if interface != PCAN:
        return bitrate_bps
    from can.interfaces.pcan.basic import PCAN_BITRATES
    nearest = min(PCAN_BITRATES, key=lambda each: abs(each - bitrate_bps))
    if abs(nearest - bitrate_bps) > _SAME_RATE * bitrate_bps:
        raise Unsupported(f"python-can's driver {PCAN} has no bit rate of {bitrate_bps} bit/s; use one of "
                          f"{', '.join(map(str, sorted(PCAN_BITRATES)))}.")
    return int(nearest)


def takes_part(interface: str, bus: Any) -> bool:
    """Return True if an adapter was ordered to only listen and its driver reports otherwise; python-can does not
    check."""
    return interface in _TAKES_PART and _TAKES_PART[interface](bus)


def _pcan_takes_part(bus: Any) -> bool:
    from can.interfaces.pcan.basic import PCAN_ERROR_OK, PCAN_LISTEN_ONLY, PCAN_PARAMETER_ON
    result, mode = bus.m_objPCANBasic.GetValue(bus.m_PcanHandle, PCAN_LISTEN_ONLY)
    return bool(result != PCAN_ERROR_OK or mode != PCAN_PARAMETER_ON)


def _vector_takes_part(bus: Any) -> bool:
    """Return True if another program has the channel's init access: the driver then keeps that program's mode."""
    return bool(bus.permission_mask & bus.mask != bus.mask)


_TAKES_PART: Mapping[str, Callable[[Any], bool]] = {PCAN: _pcan_takes_part, VECTOR: _vector_takes_part}


def fd_options(interface: str, bitrate_bps: int, data_bitrate_bps: int) -> dict[str, Any]:
    """Options for CAN FD; Unsupported if the driver has none, ValueError for rates that it does not support."""
    if interface not in _FD:
        raise Unsupported(f"python-can's driver {interface} has no CAN FD; use one of {', '.join(sorted(_FD))}, or "
                          "leave the data bit rate out for classic CAN.")
    return _FD[interface](bitrate_bps, data_bitrate_bps)


def _by_timing(bitrate_bps: int, data_bitrate_bps: int) -> dict[str, Any]:
    """Return exact bit timing; the driver's named rates lack 5 Mbit/s or have sample points at 70 %."""
    return {"timing": can.BitTimingFd.from_sample_point(_FD_CLOCK_HZ, bitrate_bps, _SAMPLE_POINT_PERCENT,
                                                        data_bitrate_bps, _SAMPLE_POINT_PERCENT)}


_FD: Mapping[str, Callable[[int, int], dict[str, Any]]] = {
    SLCAN: lambda _, data_bps: {"data_bitrate": data_bps},
    PCAN: _by_timing,
    "kvaser": _by_timing,
    VECTOR: _by_timing,
    IXXAT: lambda _, data_bps: {"fd": True, "data_bitrate": data_bps},
    "nixnet": lambda _, data_bps: {"fd": True, "fd_bitrate": data_bps},
    SOCKETCAN: lambda *_: {"fd": True},
    "virtual": lambda *_: {"protocol": can.CanProtocol.CAN_FD},
    "udp_multicast": lambda *_: {"fd": True}}
