"""Makes the fake firmware importable by the tests beside it, and has a core that it answers."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))


@pytest.fixture
def core():
    """One that has heard of an application that wants no press."""
    from peripherals_under_test import LIVE, START, restarted

    from mtr_peripherals.firmware import FirmwareReport
    found = restarted()
    found.step(LIVE, FirmwareReport(START), START)
    return found
