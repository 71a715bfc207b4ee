"""The studies by their names; each is loaded when it is wanted."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
from typing import Callable

Study = Callable[[argparse.Namespace], list[str]]


def study_of(name: str) -> Study:
    """What runs it, and gives sentences on what came of it."""
    from . import antennas, sensors
    return {"antennas": antennas.study, "sensors": sensors.study}[name]
