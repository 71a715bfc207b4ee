"""Records of one run of a test, and its assistants at the Car."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, field

from ..assistance import ExtenderPort, HandlePort
from ..distance_feed import DistanceFeed
from ..eventlog.event_log import EventLog
from ..interfaces.car_bus import CarEquipment
from ..results.course import Course
from ..results.journal import Journal
from ..results.refusals import Refusals


@dataclass(frozen=True)
class RunContext:
    """Records of one run; the defaults store nothing.

    Attributes:
        journal: stores events, presses and measurements before the robot gets its next order.
        course: stores each Status, and what is expected of the Car.
        event_log: receives what happens to robot and Car.
        refusals: counts rejected messages.
    """

    journal: Journal = field(default_factory=Journal)
    course: Course = field(default_factory=Course)
    event_log: EventLog = field(default_factory=EventLog)
    refusals: Refusals = field(default_factory=Refusals)


@dataclass(frozen=True)
class Assistance:
    """Assistants of one run, an output of the Car link before a person; None for each that is absent.

    Attributes:
        person: pulls the Car's handle if no output does. switcher: switches the extender if no output does.
        phone: reports the distance of a phone in place of the Car's own feed.
        equipment: outputs and feed of the Car link.
    """

    person: HandlePort | None = None
    switcher: ExtenderPort | None = None
    phone: DistanceFeed | None = None
    equipment: CarEquipment = field(default_factory=CarEquipment)

    @property
    def handle(self) -> HandlePort | None:
        """Port that pulls the Car's handle."""
        return self.equipment.handle or self.person

    @property
    def extender(self) -> ExtenderPort | None:
        """Port that switches the extender."""
        return self.equipment.extender or self.switcher

    @property
    def distance_feed(self) -> DistanceFeed | None:
        """Feed of a phone's distance."""
        return self.phone or self.equipment.distance_feed
