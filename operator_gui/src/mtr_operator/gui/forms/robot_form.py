"""Address and ports of the robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from PyQt5.QtCore import pyqtSignal
from PyQt5.QtWidgets import QCompleter, QVBoxLayout, QWidget

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.station.connection import RobotChoice, robot_choice

from ..sentences import translated
from ..theme.scale import M
from .field import Field


class RobotForm(QWidget):
    """Attributes: host, subscriber_port, publisher_port: the fields. Signals: submitted: Enter was pressed.

    changed: something else was typed.
    """

    submitted = pyqtSignal()
    changed = pyqtSignal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.host = Field(self.tr("IP address"), self.tr("of the robot, e.g. 192.168.0.10"))
        self.subscriber_port = Field(self.tr("Subscriber port"), self.tr("where this laptop hears the robot, usually "
                                                                         "3334"))
        self.publisher_port = Field(self.tr("Publisher port"), self.tr("where the robot hears this laptop, usually "
                                                                       "3333"))
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(M)
        for field in self._fields:
            field.edit.returnPressed.connect(self.submitted)
            field.changed.connect(lambda field=field: field.show_fault(""))
            field.changed.connect(self.changed)
            layout.addWidget(field)
        layout.addStretch(1)

    @property
    def _fields(self) -> tuple[Field, ...]:
        return self.host, self.subscriber_port, self.publisher_port

    @property
    def typed_host(self) -> str:
        """What stands in the field, valid or not."""
        return self.host.text.strip()

    def show_choice(self, choice: RobotChoice, hosts: Sequence[str]) -> None:
        """Fill the fields; hosts are offered while typing."""
        self.host.edit.setText(choice.host)
        self.host.edit.setCompleter(QCompleter(list(hosts), self))
        self.subscriber_port.edit.setText(str(choice.subscriber_port))
        self.publisher_port.edit.setText(str(choice.publisher_port))

    @property
    def choice(self) -> RobotChoice | None:
        """What was typed; None, and shown at the field, when it is not valid."""
        for field in self._fields:
            field.show_fault("")
        try:
            return robot_choice(self.host.text, self.subscriber_port.text, self.publisher_port.text)
        except InvalidParameter as error:
            self._blame(translated(str(error)), str(error))
            return None

    def _blame(self, sentence: str, original: str) -> None:
        field = self.subscriber_port if "subscriber port" in original.lower() else \
            self.publisher_port if "publisher port" in original else self.host
        field.show_fault(sentence)
        field.edit.setFocus()
