"""Optional interfaces of a Car link: its monitored and recorded bus, and equipment at the Car.

A link derives from those that it offers; a client gets the one that it needs by `part(link, BusMonitor)`.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Mapping, Sequence

from ..assistance import ExtenderPort, HandlePort
from ..distance_feed import DistanceFeed
from ..ports import BusMark, BusMessages, BusTraffic
from ..results.refused import Refused
from ..supervision.car_signals import CarSignals


class BusMonitor:
    """State of the Car's bus and its further signals; the defaults are for a Car without a bus."""

    @property
    def signals(self) -> CarSignals:
        """Signals of ignition, gear, speed and doors in this Car's profile; empty without any."""
        return ()

    @property
    def traffic(self) -> BusTraffic | None:
        """Traffic of the bus; None without one."""
        return None

    @property
    def record(self) -> Mapping[str, str]:
        """Description of the Car's bus and profile, for the record of a test: names and texts."""
        return {}

    @property
    def notices(self) -> Sequence[str]:
        """Sentences for the Operator before a test, from connect() on."""
        return ()

    @property
    def messages(self) -> BusMessages | None:
        """Return each message of the bus; None without one. May be called from any thread."""
        return None

    @property
    def refused(self) -> Refused:
        """Rejected frames of the Car's lock message since the start."""
        return Refused()


class BusRecorder:
    """Log of the whole bus; without a bus nothing is logged."""

    def log_to(self, path: pathlib.Path | None) -> None:
        """Log the whole bus to this file from now on, in the format of its suffix; None ends the log.

        OutputError if it cannot be started.
        """

    @property
    def log_problem(self) -> str:
        """Reason of an early end of the log; empty while it continues, and without one."""
        return ""

    @property
    def mark(self) -> BusMark | None:
        """Position of the log at the newest Status; None without a log."""
        return None


class CarEquipment:
    """Outputs at the Car and the feed of a phone's distance; None for each that is absent."""

    @property
    def handle(self) -> HandlePort | None:
        """Output that pulls this car's handle; None without one, so that a person must pull it."""
        return None

    @property
    def extender(self) -> ExtenderPort | None:
        """Output that switches the extender; None without one, so that a person must switch it."""
        return None

    @property
    def distance_feed(self) -> DistanceFeed | None:
        """Feed of a phone's distance on this Car's bus, or from its profile; None without one. It is connected, and
        closed, with this link."""
        return None
