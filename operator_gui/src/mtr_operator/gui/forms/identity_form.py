"""Identity of a test: car, key, operator, place, weather, notes, photos and equipment; folded to one line."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QCompleter, QGridLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from mtr_operator.domain.errors import InvalidIdentity
from mtr_operator.domain.identity.identity import OF_A_CAR, TITLES, Identity
from mtr_operator.domain.identity.laboratory import Laboratory
from mtr_operator.station.identity_entry import FIELDS, known_car, proposed, read, typed
from mtr_operator.station.settings import Settings
from mtr_operator.station.settings_file import SettingsStore
from mtr_operator.storage.identity_file import GivenIdentity, load_laboratory

from ..fitting.breaks import breakable
from ..i18n import decimal_sign
from ..names import identity_title
from ..pictures.identity_tables import subtitle
from ..sentences import translated
from ..theme.scale import L, M, S
from .field import Field
from .photos_row import PhotosRow
from .text_area import TextArea

_COLUMNS = 2
_AREAS = ("notes", "equipment")


class IdentityForm(QWidget):
    """Attributes: more: button that unfolds it. fields: by key of the record. photos. summary: what is known, folded.

    fault: what the laboratory misses.

    Signals: changed: something else was typed.
    """

    changed = pyqtSignal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._laboratory = Laboratory()
        self._settings = Settings()
        self._problem = ""
        self._is_filling = False
        hints = {"notes": "", "equipment": self.tr("One a line: name; serial number; calibrated; valid until")}
        self.fields: dict[str, Field | TextArea] = {}
        for name in FIELDS:
            title = identity_title(TITLES[name])
            self.fields[name] = TextArea(title, hints[name]) if name in _AREAS else \
                Field(title, unit="V" if name == "key_battery_v" else None)
            self.fields[name].changed.connect(self._check)
        self.fields["car_vin"].changed.connect(self._take_up_car)
        self.photos = PhotosRow(identity_title(TITLES["photos"]))
        self.photos.changed.connect(self._check)
        self.more = QPushButton()
        self.more.setCheckable(True)
        self.more.setProperty("role", "flat")
        self.summary, self.fault = QLabel(), QLabel()
        for label, role in ((self.summary, "soft"), (self.fault, "error")):
            label.setWordWrap(True)
            label.setProperty("role", role)
        self._all = QWidget()
        self._lay_out()
        self.more.toggled.connect(self._unfold)
        self._unfold(False)

    def _lay_out(self) -> None:
        grid = QGridLayout(self._all)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(L)
        grid.setVerticalSpacing(S)
        for column in range(_COLUMNS):
            grid.setColumnStretch(column, 1)
        short = [name for name in FIELDS if name not in _AREAS]
        for index, name in enumerate(short):
            grid.addWidget(self.fields[name], index // _COLUMNS, index % _COLUMNS, Qt.AlignmentFlag.AlignTop)
        for widget in (*(self.fields[name] for name in _AREAS), self.photos):
            grid.addWidget(widget, grid.rowCount(), 0, 1, _COLUMNS)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, M, 0)
        layout.setSpacing(S)
        layout.addWidget(self.more, 0, Qt.AlignmentFlag.AlignLeft)
        for label in (self.summary, self.fault, self._all):
            layout.addWidget(label)

    @property
    def given(self) -> GivenIdentity:
        """What was typed and chosen; what is wrong counts as empty."""
        return GivenIdentity(self._read()[0], self.photos.paths)

    @property
    def problem(self) -> str:
        """Why no test can begin with this, a sentence; empty when one can."""
        identity, faults = self._read()
        wrong = self._problem or next(iter(faults.values()), "") or self.photos.fault
        if wrong:
            return wrong
        try:
            self._laboratory.check(identity, len(self.photos.paths))
        except InvalidIdentity as error:
            return str(error)
        return ""

    def propose(self, store: SettingsStore, former: Identity | None = None) -> None:
        """Show what the next test has in common with the last one, or with a former one, and learn what the laboratory
        requires."""
        self._problem, self._laboratory = "", Laboratory()
        try:
            self._laboratory = load_laboratory(store.laboratory_path)
        except InvalidIdentity as error:
            self._problem = str(error)
        self._offer_cars(store.settings)
        self._is_filling = True
        for name, text in typed(proposed(store, datetime.date.today(), former), decimal_sign()).items():
            field = self.fields[name]
            field.show_text(text)
        self.photos.show_paths(())
        self._is_filling = False
        self._check()
        self.more.setChecked(bool(self.problem))

    def _offer_cars(self, settings: Settings) -> None:
        """VINs of before are proposed while one is typed."""
        self._settings = settings
        completer = QCompleter([car.car_vin for car in settings.cars], self)
        completer.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        completer.setFilterMode(Qt.MatchFlag.MatchContains)
        vin = self.fields["car_vin"]
        if isinstance(vin, Field):
            vin.edit.setCompleter(completer)

    def _take_up_car(self) -> None:
        """A VIN of before brings its model, software and key along; what is not known of it stays."""
        car = known_car(self._settings, self.fields["car_vin"].text)
        if self._is_filling or car is None:
            return
        self._is_filling = True
        for name in OF_A_CAR:
            if name != "car_vin" and getattr(car, name):
                self.fields[name].show_text(getattr(car, name))
        self._is_filling = False
        self._check()

    def _read(self) -> tuple[Identity, dict[str, str]]:
        return read({name: field.text for name, field in self.fields.items()})

    def _check(self) -> None:
        if self._is_filling:
            return
        identity, faults = self._read()
        for name, field in self.fields.items():
            # A field says its own name, not that of a key in files.
            field.show_fault(translated(faults.get(name, "")).replace(name, identity_title(TITLES[name])))
        required = set(self._laboratory.missing(identity, len(self.photos.paths)))
        self.summary.setText(subtitle(identity) or self.tr("Nothing is said of car, key and operator."))
        self.fault.setText(breakable(self._fault(required)))
        self.fault.setVisible(bool(self.fault.text()))
        self.changed.emit()

    def _fault(self, required: set[str]) -> str:
        if self._problem:
            return translated(self._problem)
        if not required:
            return ""
        names = ", ".join(identity_title(TITLES[name]) for name in TITLES if name in required)
        return self.tr("The laboratory requires: {names}.").format(names=names)

    def _unfold(self, is_shown: bool) -> None:
        self._all.setVisible(is_shown)
        self.summary.setVisible(not is_shown)
        sign = "\N{BLACK DOWN-POINTING SMALL TRIANGLE}" if is_shown else "\N{BLACK RIGHT-POINTING SMALL TRIANGLE}"
        words = self.tr("Car, key and operator")
        self.more.setText(f"{sign} {words}")
