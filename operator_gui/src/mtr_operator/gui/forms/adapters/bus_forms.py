"""One adapter for each further bus that the Car's profile declares."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterable, Sequence

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QLabel, QVBoxLayout, QWidget

from mtr_operator.station.connection import BusChoice

from ...fitting.breaks import breakable
from ...theme.scale import M
from .adapter_fields import AdapterFields


class BusForm(QWidget):
    """Attributes: bus: its name. fields: of its adapter."""

    def __init__(self, bus: str, number: int, parent: QWidget | None = None):
        super().__init__(parent)
        self.bus = bus
        self.fields = AdapterFields(number, bus, self)
        heading = QLabel(self.tr("Bus {name}").format(name=breakable(bus)))
        heading.setProperty("role", "large")
        hint = QLabel(self.tr("The Car's profile needs this bus, too. Its adapter only listens."))
        hint.setProperty("role", "hint")
        for label in (heading, hint):
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setWordWrap(True)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(M)
        layout.addWidget(heading)
        self.fields.add_to(layout, hint)
        self.fields.interface.currentIndexChanged.connect(self._suit_interface)
        self._suit_interface()

    def _suit_interface(self) -> None:
        self.fields.suit_interface(self.fields.interface.currentData() is not None)

    def show_choice(self, choice: BusChoice) -> None:
        """Fill the fields."""
        self.fields.show_interface(choice.interface)
        self.fields.show_adapter(choice.channel, choice.bitrate_bps, choice.data_bitrate_bps)

    @property
    def choice(self) -> BusChoice | None:
        """What is chosen; None without an adapter."""
        fields = self.fields
        interface = fields.interface.currentData()
        return None if interface is None else BusChoice(
            self.bus, interface, fields.channel.text.strip(), fields.bitrate_bps, fields.data_bitrate_bps)


class BusForms(QWidget):
    """A form that is not shown any more keeps what was typed, for the profile may be chosen again.

    Attributes: forms: by the name of the bus, of all that were shown.
    Signals: as of AdapterFields.
    """

    submitted = pyqtSignal()
    changed = pyqtSignal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.forms: dict[str, BusForm] = {}
        self._shown: tuple[str, ...] = ()
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(M)
        self.hide()

    def show_buses(self, names: Sequence[str]) -> None:
        """Ask for the adapters of these."""
        if tuple(names) == self._shown:
            return
        self._shown = tuple(names)
        for form in self.forms.values():
            self._column.removeWidget(form)
        for number, name in enumerate(names, 1):
            self._column.addWidget(self._form(name, number))
        for name, form in self.forms.items():
            form.setVisible(name in self._shown)
        self.setVisible(bool(names))

    def _form(self, name: str, number: int) -> BusForm:
        if name not in self.forms:
            form = self.forms[name] = BusForm(name, number, self)
            form.fields.submitted.connect(self.submitted)
            form.fields.changed.connect(self.changed)
        return self.forms[name]

    @property
    def shown(self) -> tuple[BusForm, ...]:
        """The forms of the buses that are asked for, in their order."""
        return tuple(self.forms[name] for name in self._shown)

    def show_choices(self, choices: Iterable[BusChoice]) -> None:
        """Fill the fields of the buses that are asked for."""
        for choice in choices:
            if choice.bus in self._shown:
                self.forms[choice.bus].show_choice(choice)

    @property
    def choices(self) -> tuple[BusChoice, ...]:
        """Of the buses that are asked for and have an adapter."""
        return tuple(choice for form in self.shown if (choice := form.choice) is not None)

    def show_fault(self, bus: str, sentence: str) -> None:
        """Say, at the field for it, why the adapter of a bus cannot be used."""
        if bus in self._shown:
            self.forms[bus].fields.channel.show_fault(sentence)
