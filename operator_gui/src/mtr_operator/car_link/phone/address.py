"""Address of a feed of a phone's distance, in one word: tcp:HOST:PORT, serial:DEVICE:BAUD or simulated."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from mtr_operator.domain.distance_feed import DistanceFeed
from mtr_operator.domain.errors import InvalidParameter

from .simulated import USUAL_PHONE, PhoneModel, SimulatedPhone, phone_model

TCP, SERIAL, SIMULATED = "tcp", "serial", "simulated"
_ALLOWED = "tcp:HOST:PORT, serial:DEVICE:BAUD or simulated:NAME=VALUE,..."
_MIN_BAUD, _MAX_BAUD = 300, 4_000_000
_MAX_PORT = 65_535


@dataclass(frozen=True)
class FeedAddress:
    """kind: TCP, SERIAL or SIMULATED. place: host or device. number: port or baud. model: of a simulated phone."""

    kind: str
    place: str = ""
    number: int = 0
    model: PhoneModel = USUAL_PHONE


def feed_address(text: str) -> FeedAddress:
    """Parse an address that a person entered; InvalidParameter states the allowed forms."""
    kind, _, rest = text.partition(":")
    if kind == SIMULATED:
        return FeedAddress(SIMULATED, model=phone_model(rest))
    place, _, number = rest.rpartition(":")
    if kind not in (TCP, SERIAL) or not place or not number.isdecimal():
        raise InvalidParameter(f"The feed of the phone's distance is {text[:80]!r}; allowed is {_ALLOWED}.")
    low, high = (1, _MAX_PORT) if kind == TCP else (_MIN_BAUD, _MAX_BAUD)
    # More digits than Python reads exceed the limit as well.
    if len(number) > len(str(high)) or not low <= int(number) <= high:
        what = "port" if kind == TCP else "baud rate"
        raise InvalidParameter(f"The {what} of the phone's feed is {number[:20]}; allowed is {low} to {high}.")
    return FeedAddress(kind, place.strip("[]") if kind == TCP else place, int(number))


def feed_at(address: FeedAddress, seed: int = 1) -> DistanceFeed:
    """Return a feed that is not connected yet; seed: of a simulated one."""
    if address.kind == SIMULATED:
        return SimulatedPhone(seed, address.model)
    from .line_feed import LineFeed
    if address.kind == TCP:
        from .tcp_source import TcpSource
        return LineFeed(TcpSource(address.place, address.number))
    from .serial_source import SerialSource
    return LineFeed(SerialSource(address.place, address.number))
