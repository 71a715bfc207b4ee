"""Battery that drains evenly; 270 Wh last four hours of basic use of a Jackal according to its data sheet."""
# SPDX-License-Identifier: Apache-2.0
from .readings import BatteryReading

CAPACITY_WH = 270.0
POWER_W = CAPACITY_WH / 4.0
CHARGE_AT_START = 0.95
EMPTY_V, FULL_V = 24.0, 29.4


def battery(elapsed_s: float) -> BatteryReading:
    """Return the state of the battery after that time of use."""
    charge = max(0.0, CHARGE_AT_START - POWER_W * elapsed_s / 3600.0 / CAPACITY_WH)
    voltage = EMPTY_V + (FULL_V - EMPTY_V) * charge
    return BatteryReading(charge, voltage, -POWER_W / voltage)
