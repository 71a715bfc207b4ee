"""Content of the live view of the Car's bus at one instant."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from mtr_operator.domain.ports import BusMessages, BusTraffic

from .time_line import LockEvent, Moment


@dataclass(frozen=True)
class BusView:
    """Content of the view. messages, traffic: None without a bus. problem: of the bus, one sentence or empty.

    moments, events: locks with the key's distance, see TimeLine.
    """

    messages: BusMessages | None = None
    traffic: BusTraffic | None = None
    problem: str = ""
    moments: tuple[Moment, ...] = ()
    events: tuple[LockEvent, ...] = ()
