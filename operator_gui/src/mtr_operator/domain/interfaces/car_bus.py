"""Further interfaces of a Car link: its bus as it is monitored and recorded, and equipment at the Car.

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
    """State of the Car's bus and its further signals; the defaults are those of a Car without a bus."""

    @property
    def signals(self) -> CarSignals:
        """Signals of ignition, gear, speed and doors that this Car's profile names; empty when it names none."""
        return ()

    @property
    def traffic(self) -> BusTraffic | None:
        """What comes over the bus; None where there is none to ask."""
        return None

    @property
    def record(self) -> Mapping[str, str]:
        """How the Car is watched, for the record of a test: names and texts."""
        return {}

    @property
    def notices(self) -> Sequence[str]:
        """Sentences that the Operator has to know before a test, from connect() on."""
        return ()

    @property
    def messages(self) -> BusMessages | None:
        """Each message of the bus; None where there is no bus to ask. May be asked from any thread."""
        return None

    @property
    def refused(self) -> Refused:
        """Frames of the Car's lock message that are not to be believed, since the start."""
        return Refused()


class BusRecorder:
    """Log of the whole bus; without a bus nothing is logged."""

    def log_to(self, path: pathlib.Path | None) -> None:
        """Log the whole bus into this file from now on, of the kind that its name ends in; None ends the log.

        OutputError when it cannot be begun.
        """

    @property
    def log_problem(self) -> str:
        """Why the log ended before it was to; empty while it goes on, and without one."""
        return ""

    @property
    def mark(self) -> BusMark | None:
        """How far the log has come with the newest Status; None without a log."""
        return None


class CarEquipment:
    """Outputs at the Car and the feed of a phone's distance; None for each that is absent."""

    @property
    def handle(self) -> HandlePort | None:
        """The output that takes this car's handle; None when it has none, and a person has to do it."""
        return None

    @property
    def extender(self) -> ExtenderPort | None:
        """The output that switches the extender; None when there is none, and a person has to do it."""
        return None

    @property
    def distance_feed(self) -> DistanceFeed | None:
        """What tells the distance of a phone on this Car's bus, or where its profile says; None without one. It is
        connected, and closed, with this link."""
        return None
