"""All tables together: whoever makes or compares them takes them from here."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from . import subjects, tests
from .base import Base

METADATA = Base.metadata
# What a test replaces when more of it is known, children before parents.
OF_A_TEST = (subjects.TestEquipment, tests.File, tests.Verdict, tests.Trial, tests.Measurement, tests.Line)
# As they are exported.
EXPORTED = (subjects.Campaign, subjects.Car, subjects.Key, subjects.Equipment, subjects.TestEquipment, tests.Test,
            tests.Line, tests.Measurement, tests.Trial, tests.Verdict, tests.File)
