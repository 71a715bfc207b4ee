"""Fields of one CAN adapter, which a form lays out."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re

from PyQt5.QtCore import QObject, pyqtSignal
from PyQt5.QtWidgets import QComboBox, QLabel, QVBoxLayout, QWidget

from mtr_operator.station.connection import DEFAULT_BITRATE_BPS

from ...theme.scale import XS
from ..buddy_label import BuddyLabel
from ..field import Field

# The usual ones; any other interface of python-can can be typed in.
_INTERFACES = ("pcan", "socketcan", "slcan", "kvaser", "vector", "ixxat")
_CHANNELS = {"pcan": "PCAN_USBBUS1", "socketcan": "can0", "slcan": "/dev/ttyACM0", "kvaser": "0", "vector": "0",
             "ixxat": "0"}
_BITRATES = ("125000", "250000", "500000", "1000000")
_DATA_BITRATES = ("2000000", "5000000")
_LAST_NUMBER = re.compile(r"\d+$")


class AdapterFields(QObject):
    """Attributes: interface, bitrate, data_bitrate: combo boxes. channel: field.

    Signals: submitted: Enter was pressed. changed: something else was chosen or typed.
    """

    submitted = pyqtSignal()
    changed = pyqtSignal()

    def __init__(self, number: int = 0, bus: str = "", parent: QObject | None = None):
        """number: of the bus, 0 for that of the state; each has a channel of its own to begin with. bus: name of a
        further one."""
        super().__init__(parent)
        self._number, self._bus = number, bus
        self.interface = self._make_interface()
        self.channel = Field(self.tr("Channel"), self.tr("as the adapter's driver calls it"))
        self.channel.edit.setAccessibleName(self._said(self.tr("Channel")))
        self.bitrate = editable_box(_BITRATES)
        self.bitrate.setCurrentText(str(DEFAULT_BITRATE_BPS))
        self.data_bitrate = editable_box(_DATA_BITRATES)
        self.data_bitrate.insertItem(0, self.tr("classic CAN"), 0)
        self.data_bitrate.setCurrentIndex(0)
        self.channel.edit.returnPressed.connect(self.submitted)
        self.channel.changed.connect(self.changed)
        for box in (self.bitrate, self.data_bitrate):
            box.lineEdit().returnPressed.connect(self.submitted)
        for box in (self.interface, self.bitrate, self.data_bitrate):
            box.currentTextChanged.connect(lambda _: self.changed.emit())
        self.changed.connect(lambda: self.channel.show_fault(""))

    def _make_interface(self) -> QComboBox:
        box = QComboBox()
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        box.setMinimumContentsLength(12)
        box.addItem(self.tr("None yet"), None)
        for name in _INTERFACES:
            box.addItem(name, name)
        return box

    def add_to(self, layout: QVBoxLayout, hint: QLabel) -> None:
        """Lay the fields out, one below the other. hint: for the interface."""
        self._add(layout, self.tr("CAN adapter"), self.interface, hint)
        layout.addWidget(self.channel)
        self._add(layout, self.tr("Bit rate in bit/s"), self.bitrate)
        self._add(layout, self.tr("CAN FD data in bit/s"), self.data_bitrate)

    def _add(self, layout: QVBoxLayout, title: str, box: QComboBox, hint: QLabel | None = None) -> None:
        add_titled(layout, title, box, hint)
        box.setAccessibleName(self._said(title))

    def _said(self, title: str) -> str:
        return f"{title}, {self._bus}" if self._bus else title

    @property
    def in_order(self) -> tuple[QWidget, ...]:
        """As the tabulator goes through them."""
        return self.interface, self.channel.edit, self.bitrate, self.data_bitrate

    def show_adapter(self, channel: str, bitrate_bps: int, data_bitrate_bps: int | None) -> None:
        """Fill the fields, beside the interface."""
        self.channel.edit.setText(channel)
        self.bitrate.setCurrentText(str(bitrate_bps))
        if data_bitrate_bps is not None:
            self.data_bitrate.setCurrentText(str(data_bitrate_bps))

    def show_interface(self, interface: str | None) -> None:
        """Choose the interface, even one that is not offered."""
        index = self.interface.findData(interface)
        if index < 0 and interface is not None:
            index = 1
            self.interface.insertItem(index, interface, interface)
        self.interface.setCurrentIndex(index)

    def suit_interface(self, needs_adapter: bool) -> None:
        """Whether there is anything to fill in; a channel that nobody typed follows the interface."""
        for widget in (self.channel, self.bitrate, self.data_bitrate):
            widget.setEnabled(needs_adapter)
        proposed = {name: self._numbered(channel) for name, channel in _CHANNELS.items()}
        if needs_adapter and self.channel.text in ("", *proposed.values()):
            self.channel.edit.setText(proposed.get(self.interface.currentData(), ""))

    def _numbered(self, channel: str) -> str:
        return _LAST_NUMBER.sub(lambda match: str(int(match[0]) + self._number), channel)

    @property
    def bitrate_bps(self) -> int:
        """In bit/s; what is no number is 0, which the adapter refuses with a sentence."""
        return _rate(self.bitrate)

    @property
    def data_bitrate_bps(self) -> int | None:
        """In bit/s, None for classic CAN."""
        is_classic = self.data_bitrate.currentText() in ("", self.data_bitrate.itemText(0))
        return None if is_classic else _rate(self.data_bitrate)


def editable_box(entries: tuple[str, ...]) -> QComboBox:
    """A box to choose or type in."""
    box = QComboBox()
    box.setEditable(True)
    box.addItems(entries)
    return box


def add_titled(layout: QVBoxLayout, title: str, box: QComboBox, hint: QLabel | None = None) -> None:
    """A box below its title and above its hint."""
    label = BuddyLabel(title, box)
    box.setAccessibleName(title)
    group = QVBoxLayout()
    group.setSpacing(XS)
    for widget in (label, box, *([hint] if hint else [])):
        group.addWidget(widget)
    layout.addLayout(group)


def _rate(box: QComboBox) -> int:
    text = box.currentText().strip()
    return int(text) if text.isdecimal() else 0
