"""CAN interface of the Linux kernel, which opens the adapter itself: its bit rate and listen-only mode.

The program ip (iproute2) reports them without administrator rights.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import subprocess
from dataclasses import dataclass
from typing import Any, Callable

from mtr_operator.domain.errors import ConnectionFailed

_LIMIT_S = 2.0
_LISTEN_ONLY = "LISTEN-ONLY"
# Interfaces without a wire.
_WITHOUT_WIRE = ("vcan", "vxcan")


@dataclass(frozen=True)
class KernelLink:
    """State of the interface. is_silent: it sends nothing by itself. bitrate_bps, data_bitrate_bps: None if not
    reported."""

    is_silent: bool
    bitrate_bps: int | None = None
    data_bitrate_bps: int | None = None


def show_link(channel: str) -> str:
    """Return the output of ip for an interface; OSError without output."""
    try:
        done = subprocess.run(["ip", "-details", "-json", "link", "show", "dev", channel], capture_output=True,
                              text=True, check=False, timeout=_LIMIT_S)
    except subprocess.TimeoutExpired as error:
        raise OSError(str(error)) from None
    if done.returncode:
        raise OSError(done.stderr.strip())
    return done.stdout


def link_of(text: str) -> KernelLink:
    """Parse the output of ip; ValueError if it is not an interface."""
    try:
        info = json.loads(text)[0]["linkinfo"]
        kind, data = info["info_kind"], info.get("info_data", {})
        return KernelLink(kind in _WITHOUT_WIRE or _LISTEN_ONLY in data.get("ctrlmode", ()),
                          _rate(data, "bittiming"), _rate(data, "data_bittiming"))
    except (LookupError, TypeError, AttributeError) as error:
        raise ValueError(f"no CAN interface: {error}") from None


def _rate(data: dict[str, Any], name: str) -> int | None:
    rate = data.get(name, {}).get("bitrate")
    return rate if isinstance(rate, int) else None


def check_link(channel: str, bitrate_bps: int, data_bitrate_bps: int | None, is_listening: bool,
               show: Callable[[str], str] = show_link) -> None:
    """Raise ConnectionFailed if the kernel has opened the adapter in a different way than requested."""
    try:
        link = link_of(show(channel))
    except (OSError, ValueError):
        if is_listening:
            raise ConnectionFailed(f"Whether the CAN interface {channel} only listens is not known, for the program ip "
                                   "does not tell; see that it is there and up, install iproute2, or choose normal "
                                   "mode (--can-normal) for a bench of one node.") from None
        return
    if is_listening and not link.is_silent:
        raise ConnectionFailed(f"The CAN interface {channel} takes part in the bus; have it only listen by "
                               f"{_commands(channel, bitrate_bps)}, or choose normal mode (--can-normal) for a bench "
                               "of one node.")
    for rate_bps, wanted_bps in ((link.bitrate_bps, bitrate_bps), (link.data_bitrate_bps, data_bitrate_bps)):
        if rate_bps is not None and wanted_bps is not None and rate_bps != wanted_bps:
            raise ConnectionFailed(f"The CAN interface {channel} runs at {rate_bps} bit/s, and {wanted_bps} bit/s is "
                                   "chosen; set one of them as the Car's bus is.")


def _commands(channel: str, bitrate_bps: int) -> str:
    return (f"'ip link set {channel} down', 'ip link set {channel} type can bitrate {bitrate_bps} listen-only on' and "
            f"'ip link set {channel} up'")
