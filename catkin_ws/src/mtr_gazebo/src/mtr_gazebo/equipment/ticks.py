"""Ticks since the last one, also for messages that arrive late or together."""
# SPDX-License-Identifier: Apache-2.0
from typing import Iterator

from mtr_core.schedule import CLOCK_STEP


def ticks_between(last_ns: int, now_ns: int) -> Iterator[int]:
    """Yield the times of the ticks after last_ns, which is a tick, up to now_ns."""
    yield from range(last_ns + CLOCK_STEP.period_ns, now_ns + 1, CLOCK_STEP.period_ns)
