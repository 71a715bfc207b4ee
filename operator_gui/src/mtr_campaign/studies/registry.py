"""Studies by name; each is imported on first use."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
from typing import Callable

Study = Callable[[argparse.Namespace], list[str]]


def study_of(name: str) -> Study:
    """Return the function that runs a study and returns sentences about the result."""
    from . import antennas, sensors
    return {"antennas": antennas.study, "sensors": sensors.study}[name]
