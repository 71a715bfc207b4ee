"""Opens the links to robot and Car for the window, and says what became of it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses

from PyQt5.QtCore import QObject, pyqtSignal

from mtr_operator.station.connection import CanChoice, Connection, LinkOpener
from mtr_operator.station.events import CarLinkOpened, LinkRefused, LinksOpened, StationEvent
from mtr_operator.station.links.worker import Worker
from mtr_operator.station.settings_file import SettingsStore

from ..bridge import Bridge
from .pairing import Pairing

CLOSE_LIMIT_S = 8.0


class Connecting(QObject):
    """Attributes:
        connection: in use, or tried last. worker: has the links, None before the first attempt. opener: of links.
        pairing: with a robot that is not connected yet.
    Signals:
        connected, refused(part, text, bus): how an attempt to connect ended, as in LinkRefused.
        can_opened, can_refused(text, bus): how a change of the CAN adapter ended.
    """

    connected = pyqtSignal()
    refused = pyqtSignal(str, str, str)
    can_opened = pyqtSignal()
    can_refused = pyqtSignal(str, str)

    def __init__(self, bridge: Bridge, store: SettingsStore, opener: LinkOpener):
        super().__init__()
        self._bridge = bridge
        self._store = store
        self.opener = opener
        self.pairing = Pairing(opener, self)
        self.connection = Connection()
        self.worker: Worker | None = None
        self._is_connected = False
        self._wanted_can: CanChoice | None = None
        bridge.happened.connect(self._learn)

    @property
    def links(self) -> Worker:
        """What has the links, for what is done only with a connection."""
        if self.worker is None:
            raise LookupError("nothing is connected yet")
        return self.worker

    @property
    def can_in_use(self) -> CanChoice | None:
        """The CAN adapter that is open now; None when none is."""
        return self.connection.can if self._is_connected else None

    def connect_to(self, connection: Connection) -> None:
        """Try to connect; connected or refused follows."""
        self.connection = connection
        self.worker = Worker(connection, self.opener, self._bridge.mailbox)
        self.worker.start()

    def use_can(self, choice: CanChoice | None) -> None:
        """Change the CAN adapter; can_opened or can_refused follows."""
        self._wanted_can = choice
        self.links.use_can(choice)

    def close(self) -> bool:
        """Stop the robot and disconnect; True when that has succeeded in time."""
        return self.worker is None or self.worker.close(CLOSE_LIMIT_S)

    def _learn(self, event: StationEvent) -> None:
        if isinstance(event, LinksOpened):
            self._is_connected = True
            self._keep()
            self.connected.emit()
        elif isinstance(event, LinkRefused) and self._is_connected:
            self.can_refused.emit(event.text, event.bus)
        elif isinstance(event, LinkRefused):
            self.refused.emit(event.part, event.text, event.bus)
        elif isinstance(event, CarLinkOpened):
            self.connection = dataclasses.replace(self.connection, can=self._wanted_can)
            self._keep()
            self.can_opened.emit()

    def _keep(self) -> None:
        """The next start offers this connection."""
        self._store.change(self._store.settings.with_connection(self.connection))
