"""All parameters of a scenario: those of every test at once, the rest on demand."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from typing import Any, Mapping

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtWidgets import QCheckBox, QGridLayout, QPushButton, QVBoxLayout, QWidget

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.parameters import Declaration, Flag
from mtr_operator.domain.scenario import ScenarioParameters

from ..fitting.prose import Prose
from ..names import flag_title, parameter_doc
from ..sentences import parameter_sentence
from ..theme.scale import L, M
from .choice_field import ChoiceField
from .parameter_field import ParameterField

# By convention a scenario declares the parameters that every test needs up to this one.
_LAST_MAIN = "maximum_speed_mps"
_COLUMNS = 2


class ParameterForm(QWidget):
    """A field that means nothing with what is chosen is hidden.

    Attributes: fields: numbers by parameter. choices: words by parameter. flags: check boxes by parameter. more, usual:
    buttons. fault: what does not fit together; whoever shows the form has a place for it.

    Signals: changed: something else was typed.
    """

    changed = pyqtSignal()

    def __init__(self, parameters_type: type[ScenarioParameters], parent: QWidget | None = None):
        super().__init__(parent)
        self._type = parameters_type
        self._is_filling = False
        self.fields = {name: ParameterField(name, declared)
                       for name, declared in parameters_type.declarations().items()}
        self.choices = {name: ChoiceField(name, declared) for name, declared in parameters_type.choices().items()}
        self.flags = {name: self._make_flag(name, declared) for name, declared in parameters_type.flags().items()}
        self.usual = QPushButton(self.tr("Usual values"))
        self.more = QPushButton()
        self.more.setCheckable(True)
        self.more.setProperty("role", "flat")
        self.usual.setProperty("role", "flat")
        self.fault = Prose()
        self.fault.setProperty("role", "error")
        self._main, self._rest = QWidget(), QWidget()
        self._grids = (QGridLayout(self._main), QGridLayout(self._rest))
        self.more.toggled.connect(self._show_rest)
        self._show_rest(False)
        self.usual.clicked.connect(lambda: self.show_mapping({}))
        self._lay_out()
        for field in self.fields.values():
            field.changed.connect(self._check)
        for chosen in self.choices.values():
            chosen.changed.connect(self._choose)
        for box in self.flags.values():
            box.toggled.connect(self._check)
        self.show_mapping({})

    @staticmethod
    def _make_flag(name: str, declared: Flag) -> QCheckBox:
        box = QCheckBox(flag_title(name))
        box.setToolTip(parameter_doc(declared))
        return box

    def _lay_out(self) -> None:
        for grid in self._grids:
            grid.setContentsMargins(0, 0, 0, 0)
            grid.setHorizontalSpacing(L)
            grid.setVerticalSpacing(M)
            for column in range(_COLUMNS):
                grid.setColumnStretch(column, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, M, 0)
        layout.setSpacing(M)
        for widget in (*self.choices.values(), self._main, *self.flags.values(), self.more, self._rest, self.usual):
            is_button = isinstance(widget, QPushButton)
            layout.addWidget(widget, 0, Qt.AlignmentFlag.AlignLeft if is_button else Qt.Alignment())
        layout.addStretch(1)
        # Before it has its place a button that is made visible would be a window.
        self._arrange()

    def _arrange(self) -> None:
        """Place the fields that have an effect, without gaps."""
        names = list(self.fields)
        split = names.index(_LAST_MAIN) + 1 if _LAST_MAIN in names else len(names)
        for grid, part in zip(self._grids, (names[:split], names[split:])):
            for name in part:
                grid.removeWidget(self.fields[name])
                self.fields[name].setVisible(False)
            shown = [self.fields[name] for name in part if self._has_effect(self.fields[name].declared)]
            for index, field in enumerate(shown):
                grid.addWidget(field, index // _COLUMNS, index % _COLUMNS, Qt.AlignmentFlag.AlignTop)
                field.setVisible(True)
        self.more.setVisible(split < len(names))

    def _has_effect(self, declared: Declaration) -> bool:
        return declared.only is None or self.choices[declared.only[0]].word == declared.only[1]

    def _choose(self) -> None:
        self._arrange()
        for name, field in self.fields.items():
            # What nobody sees nobody can mend.
            if not self._has_effect(field.declared) and field.reading.fault is not None:
                field.show_value(getattr(self._type(), name))
        self._check()

    def _show_rest(self, is_shown: bool) -> None:
        self._rest.setVisible(is_shown)
        sign = "\N{BLACK DOWN-POINTING SMALL TRIANGLE}" if is_shown else "\N{BLACK RIGHT-POINTING SMALL TRIANGLE}"
        words = self.tr("Fewer parameters") if is_shown else self.tr("More parameters")
        self.more.setText(f"{sign} {words}")

    @property
    def parameters(self) -> ScenarioParameters | None:
        """What was typed; None while it is not valid."""
        try:
            return None if self._faulty_fields() else self._typed()
        except InvalidParameter:
            return None

    def show_mapping(self, mapping: Mapping[str, Any]) -> None:
        """Show parameters as in a parameter file; those that are missing or no longer allowed take what is usual."""
        try:
            values = self._type.from_mapping({**self._type.proposed(), **mapping})
        except InvalidParameter:
            values = self._type.from_mapping(self._type.proposed())
        self._is_filling = True
        for name, chosen in self.choices.items():
            chosen.show_word(getattr(values, name))
        for name, field in self.fields.items():
            field.show_value(getattr(values, name))
        for name, box in self.flags.items():
            box.setChecked(getattr(values, name))
        self._is_filling = False
        self._check()

    def mark_fields(self, said: str) -> None:
        """Frame the fields of the parameters that a sentence names as files do; none for an empty one."""
        for field in self.fields.values():
            field.mark(re.search(rf"\b{field.declared.file_key}\b", said) is not None)

    def show_fault(self, sentence: str) -> None:
        """Say what does not fit together, e.g. with the Car's size."""
        self.fault.setText(sentence)
        self.fault.setVisible(bool(sentence))

    def _typed(self) -> ScenarioParameters:
        values: dict[str, Any] = {name: field.reading.value for name, field in self.fields.items()}
        values.update({name: chosen.word for name, chosen in self.choices.items()})
        values.update({name: box.isChecked() for name, box in self.flags.items()})
        return self._type(**values)

    def _faulty_fields(self) -> list[ParameterField]:
        return [field for field in self.fields.values() if field.reading.fault is not None]

    def _check(self) -> None:
        if self._is_filling:
            return
        for field in self.fields.values():
            field.check()
        sentence = said = ""
        faulty = self._faulty_fields()
        if not faulty:
            try:
                self._typed()
            except InvalidParameter as error:
                said, sentence = str(error), parameter_sentence(error, self._type)
        elif any(self._rest.isAncestorOf(field) for field in faulty):
            self.more.setChecked(True)
        self.mark_fields(said)
        self.show_fault(sentence)
        self.changed.emit()
