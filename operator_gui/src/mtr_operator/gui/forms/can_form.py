"""Choice of the CAN adapter and of the Car's profile, or none yet."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QCheckBox, QComboBox, QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.car_link.profile import profile_names
from mtr_operator.station.connection import DEFAULT_BITRATE_BPS, SIMULATED, CanChoice

from ..theme.scale import XS, M
from .buddy_label import BuddyLabel
from .field import Field

# The usual ones; any other interface of python-can can be typed in.
_INTERFACES = ("pcan", "socketcan", "slcan", "kvaser", "vector", "ixxat")
_CHANNELS = {"pcan": "PCAN_USBBUS1", "socketcan": "can0", "slcan": "/dev/ttyACM0", "kvaser": "0", "vector": "0",
             "ixxat": "0"}
_BITRATES = ("125000", "250000", "500000", "1000000")
_DATA_BITRATES = ("2000000", "5000000")


class CanForm(QWidget):
    """Attributes: interface, bitrate, data_bitrate, profile: combo boxes. channel: field. normal: check box. learn:
    button.

    Signals: submitted: Enter was pressed. changed: something else was chosen or typed. learn_wanted: of the Car that
    has no profile yet.
    """

    submitted = pyqtSignal()
    changed = pyqtSignal()
    learn_wanted = pyqtSignal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.interface = QComboBox()
        self.interface.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.interface.setMinimumContentsLength(12)
        self.interface.addItem(self.tr("None yet"), None)
        for name in _INTERFACES:
            self.interface.addItem(name, name)
        self.interface.addItem(self.tr("Simulated Car (to try the application)"), SIMULATED)
        self._may_learn = True
        self.channel = Field(self.tr("Channel"), self.tr("as the adapter's driver calls it"))
        self.bitrate = self._editable(_BITRATES)
        self.data_bitrate = self._editable(_DATA_BITRATES)
        self.data_bitrate.insertItem(0, self.tr("classic CAN"), 0)
        self.data_bitrate.setCurrentIndex(0)
        self.normal = QCheckBox(self.tr("Take part in the bus (a bench of one node)"))
        self.normal.setToolTip(self.tr("The adapter acknowledges frames. Without it the adapter only listens and sends "
                                       "nothing: a Car does not notice it."))
        self.profile = self._editable(profile_names())
        self.interface.currentIndexChanged.connect(self._suit_interface)
        self.channel.edit.returnPressed.connect(self.submitted)
        self._hint = QLabel(self.tr("Without an adapter everything but a test works."))
        self._hint.setWordWrap(True)
        self._hint.setProperty("role", "hint")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(M)
        self._add(layout, self.tr("CAN adapter"), self.interface, self._hint)
        layout.addWidget(self.channel)
        self._add(layout, self.tr("Bit rate in bit/s"), self.bitrate)
        self._add(layout, self.tr("CAN FD data in bit/s"), self.data_bitrate)
        self._add(layout, self.tr("Car profile"), self.profile)
        self.learn = QPushButton(self.tr("Learn a new Car from its bus"))
        self.learn.setProperty("role", "flat")
        self.learn.setAutoDefault(False)
        self.learn.clicked.connect(self.learn_wanted)
        layout.addWidget(self.learn, 0, Qt.AlignmentFlag.AlignLeft)
        layout.addWidget(self.normal)
        layout.addStretch(1)
        self._suit_interface()
        self.channel.changed.connect(self.changed)
        self.normal.toggled.connect(lambda _: self.changed.emit())
        for box in (self.interface, self.bitrate, self.data_bitrate, self.profile):
            box.currentTextChanged.connect(lambda _: self.changed.emit())
        self.changed.connect(lambda: self.channel.show_fault(""))

    def allow_learning(self, may_learn: bool) -> None:
        """Whether the adapter can be spared for it."""
        self._may_learn = may_learn
        self.learn.setEnabled(may_learn and self.channel.isEnabled())

    def show_fault(self, sentence: str) -> None:
        """Say, at the field for it, why the adapter cannot be used."""
        self.channel.show_fault(sentence)

    def _editable(self, entries: tuple[str, ...]) -> QComboBox:
        box = QComboBox()
        box.setEditable(True)
        box.addItems(entries)
        box.lineEdit().returnPressed.connect(self.submitted)
        return box

    @staticmethod
    def _add(layout: QVBoxLayout, title: str, box: QComboBox, hint: QLabel | None = None) -> None:
        label = BuddyLabel(title, box)
        box.setAccessibleName(title)
        group = QVBoxLayout()
        group.setSpacing(XS)
        for widget in (label, box, *([hint] if hint else [])):
            group.addWidget(widget)
        layout.addLayout(group)

    def show_choice(self, choice: CanChoice | None) -> None:
        """Fill the fields."""
        self.interface.setCurrentIndex(self._index_of(None if choice is None else choice.interface))
        if choice is None:
            self.bitrate.setCurrentText(str(DEFAULT_BITRATE_BPS))
            return
        self.channel.edit.setText(choice.channel)
        self.bitrate.setCurrentText(str(choice.bitrate_bps))
        self.profile.setCurrentText(choice.profile)
        if choice.data_bitrate_bps is not None:
            self.data_bitrate.setCurrentText(str(choice.data_bitrate_bps))
        self.normal.setChecked(choice.is_normal)

    @property
    def choice(self) -> CanChoice | None:
        """What is chosen; a bit rate that is no number becomes 0, which the adapter refuses with a sentence."""
        interface = self.interface.currentData()
        if interface is None:
            return None
        return CanChoice(interface, self.channel.text.strip(), _rate(self.bitrate), self.profile.currentText().strip(),
                         self._data_bitrate, self.normal.isChecked())

    @property
    def _data_bitrate(self) -> int | None:
        is_classic = self.data_bitrate.currentText() in ("", self.data_bitrate.itemText(0))
        return None if is_classic else _rate(self.data_bitrate)

    def _index_of(self, interface: str | None) -> int:
        index = self.interface.findData(interface)
        if index < 0 and interface is not None:
            self.interface.insertItem(1, interface, interface)
            index = 1
        return index

    def _suit_interface(self) -> None:
        interface = self.interface.currentData()
        needs_adapter = interface not in (None, SIMULATED)
        for widget in (self.channel, self.bitrate, self.data_bitrate, self.profile, self.normal):
            widget.setEnabled(needs_adapter)
        self.learn.setEnabled(needs_adapter and self._may_learn)
        self._hint.setVisible(interface is None)
        known = self.channel.text in ("", *_CHANNELS.values())
        if needs_adapter and known:
            self.channel.edit.setText(_CHANNELS.get(interface, ""))


def _rate(box: QComboBox) -> int:
    text = box.currentText().strip()
    return int(text) if text.isdecimal() else 0
