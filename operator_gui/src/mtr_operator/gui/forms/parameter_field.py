"""Field of one scenario parameter, in the unit that a person uses; it says at once why a value is not allowed."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any

from PyQt5.QtWidgets import QWidget

from mtr_operator.domain.parameters import Declaration
from mtr_operator.station.number_text import Fault, Reading, read, shown_range, shown_value, written

from ..i18n import decimal_sign, translate
from ..names import parameter_doc, parameter_title
from .field import Field


class ParameterField(Field):
    """A Field that knows its parameter's declaration.

    Attributes: declared: see Declaration.
    """

    def __init__(self, name: str, declared: Declaration, parent: QWidget | None = None):
        self.declared = declared
        super().__init__(parameter_title(name, declared), _range_text(declared), declared.shown[0], parent)
        self.setToolTip(parameter_doc(declared))

    @property
    def reading(self) -> Reading:
        """What the text says."""
        return read(self.declared, self.text)

    def show_value(self, value: Any) -> None:
        """Show an SI value; None empties the field."""
        self.edit.setText(shown_value(self.declared, value, decimal_sign()))

    def check(self) -> bool:
        """Show what is wrong with the text; True when nothing is."""
        fault = self.reading.fault
        self.show_fault("" if fault is None else _sentence(fault, self.declared))
        return fault is None


def _range_text(declared: Declaration) -> str:
    low, high, unit = _limits(declared)
    if declared.default is None:
        return translate("ParameterField", "{low} to {high} {unit}; may be empty").format(low=low, high=high, unit=unit)
    default = written(declared.default * declared.shown[1], decimal_sign())
    return translate("ParameterField", "{low} to {high} {unit}, usually {default}").format(
        low=low, high=high, unit=unit, default=default).replace(" ,", ",")


def _sentence(fault: Fault, declared: Declaration) -> str:
    low, high, unit = _limits(declared)
    return {
        Fault.EMPTY: translate("ParameterField", "Enter a value from {low} to {high} {unit}."),
        Fault.NOT_A_NUMBER: translate("ParameterField", "This is not a number; allowed is {low} to {high} {unit}."),
        Fault.NOT_WHOLE: translate("ParameterField", "Only whole numbers are allowed, {low} to {high} {unit}."),
        Fault.OUT_OF_RANGE: translate("ParameterField", "Allowed is {low} to {high} {unit}."),
    }[fault].format(low=low, high=high, unit=unit).replace(" .", ".")


def _limits(declared: Declaration) -> tuple[str, str, str]:
    low, high = shown_range(declared)
    return written(low, decimal_sign()), written(high, decimal_sign()), declared.shown[0]
