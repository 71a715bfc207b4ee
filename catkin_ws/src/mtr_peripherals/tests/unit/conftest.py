"""Makes the fake firmware of this folder importable, and provides a core connected to it."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))


@pytest.fixture
def core():
    """Return a core with an application in control that requests no press."""
    from peripherals_under_test import LIVE, START, restarted

    from mtr_peripherals.firmware import FirmwareReport
    found = restarted()
    found.step(LIVE, FirmwareReport(START), START)
    return found
