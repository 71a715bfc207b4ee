"""Data sheet of the simulated Car, as a laboratory fills it in for its robot."""
# SPDX-License-Identifier: Apache-2.0
from mtr_car_locator.parameters import DataSheet
from mtr_simulation.site.scenario import named_scenario

MILLIMETRE_DIGITS = 3
# What a data sheet states; all other parameters keep their defaults.
FIELDS = ("known_length_m", "known_width_m", "front_overhang_m", "wheelbase_m")


def data_sheet_of(site: str) -> DataSheet:
    """Data sheet of the Car of a site, in whole millimetres. Its overhangs are equal."""
    shape = named_scenario(site).car
    values_m = (shape.length_m, shape.width_m, 0.5 * (shape.length_m - shape.wheelbase_m), shape.wheelbase_m)
    return DataSheet(**{name: round(value_m, MILLIMETRE_DIGITS) for name, value_m in zip(FIELDS, values_m)})


def car_file_of(site: str) -> str:
    """The same as the text of a car_file."""
    sheet = data_sheet_of(site)
    return "".join(f"{name}: {getattr(sheet, name)}\n" for name in FIELDS)
