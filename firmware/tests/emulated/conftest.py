"""Boards and their hosts for the tests in lock-step."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import pathlib
import sys

import pytest

FIRMWARE = pathlib.Path(__file__).resolve().parents[2]
# How far from where it was sent the lift may come to rest.
HEIGHT_TOLERANCE_M = 0.002
sys.path[:0] = [str(FIRMWARE / "emulator" / "python"), str(FIRMWARE / "tests" / "emulated")]

from serial_host import NEGOTIATE, Host, frame  # noqa: E402

from mtr_emulator.emulator import MCUS, Emulator  # noqa: E402


@contextlib.contextmanager
def running_host(mcu, **options):
    """A host on a stepped board."""
    with Emulator(mcu, stepped=True, **options) as board:
        host = Host(board)
        host.send(frame(NEGOTIATE))
        try:
            yield host
        finally:
            host.close()


@pytest.fixture(params=MCUS)
def mcu(request):
    """Each microcontroller."""
    return request.param


@pytest.fixture
def host(mcu):
    """A host whose board has been commanded for half a second."""
    with running_host(mcu) as running:
        running.run(0.5)
        yield running
