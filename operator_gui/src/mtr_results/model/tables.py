"""All tables, for creation and comparison."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from . import subjects, tests
from .base import Base

METADATA = Base.metadata
# Tables that are replaced when a more complete copy of a test arrives, children before parents.
OF_A_TEST = (subjects.TestEquipment, tests.File, tests.Verdict, tests.Trial, tests.Measurement, tests.Line)
# Exported tables, in order.
EXPORTED = (subjects.Campaign, subjects.Car, subjects.Key, subjects.Equipment, subjects.TestEquipment, tests.Test,
            tests.Line, tests.Measurement, tests.Trial, tests.Verdict, tests.File)
