"""Choice of the CAN adapters and of the Car's profile, or none yet."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QCheckBox, QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.car_link.profile import bus_names, profile_names
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.station.connection import SIMULATED, CanChoice

from ..theme.scale import M
from .adapters.adapter_fields import AdapterFields, add_titled, editable_box
from .adapters.bus_forms import BusForms


class CanForm(QWidget):
    """Attributes: interface, bitrate, data_bitrate, profile: combo boxes. channel: field. normal: check box. learn:
    button. further: of the further buses that the profile declares.

    Signals: submitted: Enter was pressed. changed: something else was chosen or typed. learn_wanted: of the Car that
    has no profile yet.
    """

    submitted = pyqtSignal()
    changed = pyqtSignal()
    learn_wanted = pyqtSignal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._may_learn = True
        self._fields = fields = AdapterFields(parent=self)
        self.interface, self.channel = fields.interface, fields.channel
        self.bitrate, self.data_bitrate = fields.bitrate, fields.data_bitrate
        self.interface.addItem(self.tr("Simulated Car (to try the application)"), SIMULATED)
        self.normal = QCheckBox(self.tr("Take part in the bus (a bench of one node)"))
        self.normal.setToolTip(self.tr("The adapter acknowledges frames. Without it the adapter only listens and sends "
                                       "nothing: a Car does not notice it."))
        self.profile = editable_box(profile_names())
        self._hint = QLabel(self.tr("Without an adapter everything but a test works."))
        self._hint.setWordWrap(True)
        self._hint.setProperty("role", "hint")
        self.learn = QPushButton(self.tr("Learn a new Car from its bus"))
        self.learn.setProperty("role", "flat")
        self.learn.setAutoDefault(False)
        self.further = BusForms(self)
        self._lay_out()
        self._suit_interface()
        self._connect()

    def _lay_out(self) -> None:
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(M)
        self._fields.add_to(layout, self._hint)
        add_titled(layout, self.tr("Car profile"), self.profile)
        layout.addWidget(self.learn, 0, Qt.AlignmentFlag.AlignLeft)
        layout.addWidget(self.normal)
        layout.addWidget(self.further)
        layout.addStretch(1)

    def _connect(self) -> None:
        self.interface.currentIndexChanged.connect(self._suit_interface)
        self.profile.currentTextChanged.connect(self._suit_profile)
        self.learn.clicked.connect(self.learn_wanted)
        for part in (self._fields, self.further):
            part.submitted.connect(self.submitted)
            part.changed.connect(self.changed)
        self.profile.lineEdit().returnPressed.connect(self.submitted)
        self.normal.toggled.connect(lambda _: self.changed.emit())
        self.profile.currentTextChanged.connect(lambda _: self.changed.emit())
        self.changed.connect(lambda: self.channel.show_fault(""))

    def allow_learning(self, may_learn: bool) -> None:
        """Whether the adapter can be spared for it."""
        self._may_learn = may_learn
        self.learn.setEnabled(may_learn and self.channel.isEnabled())

    def show_fault(self, sentence: str, bus: str = "") -> None:
        """Say, at the field for it, why the adapter cannot be used. bus: name of a further one."""
        if bus:
            # The profile may have been written anew since it was chosen.
            self._suit_profile()
            self.further.show_fault(bus, sentence)
        else:
            self.channel.show_fault(sentence)

    def show_choice(self, choice: CanChoice | None) -> None:
        """Fill the fields."""
        self._fields.show_interface(None if choice is None else choice.interface)
        if choice is None:
            return
        self._fields.show_adapter(choice.channel, choice.bitrate_bps, choice.data_bitrate_bps)
        self.profile.setCurrentText(choice.profile)
        self.normal.setChecked(choice.is_normal)
        self.further.show_choices(choice.further)

    @property
    def choice(self) -> CanChoice | None:
        """What is chosen; a bit rate that is no number becomes 0, which the adapter refuses with a sentence."""
        interface = self.interface.currentData()
        if interface is None:
            return None
        return CanChoice(interface, self.channel.text.strip(), self._fields.bitrate_bps,
                         self.profile.currentText().strip(), self._fields.data_bitrate_bps, self.normal.isChecked(),
                         self.further.choices)

    @property
    def _needs_adapter(self) -> bool:
        return self.interface.currentData() not in (None, SIMULATED)

    def _suit_interface(self) -> None:
        self._fields.suit_interface(self._needs_adapter)
        for widget in (self.profile, self.normal):
            widget.setEnabled(self._needs_adapter)
        self.learn.setEnabled(self._needs_adapter and self._may_learn)
        self._hint.setVisible(self.interface.currentData() is None)
        self._suit_profile()

    def _suit_profile(self) -> None:
        """One adapter more for each further bus; a wrong profile is told when it is used."""
        try:
            names = bus_names(self.profile.currentText().strip()) if self._needs_adapter else ()
        except ConnectionFailed:
            names = ()
        self.further.show_buses(names)
        before: QWidget = self.normal
        for field in (field for form in self.further.shown for field in form.fields.in_order):
            QWidget.setTabOrder(before, field)
            before = field
