"""The strength at which a press works: the strongest that did not, and the weakest of those that always did."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Sequence

from .readings import Estimate, ReadingsUnusable

# More strength than the button needs, for a key that sits otherwise and a weak battery of the servo.
MARGIN = 1.25


@dataclass(frozen=True)
class Press:
    """strength: 0 to 1, as ordered. force_n: what a gauge in the key's place read, N. worked: the button went down."""

    strength: float
    force_n: float
    worked: bool


@dataclass(frozen=True)
class PressNeed:
    """force: that the button needs, N. strength: that is to be ordered at least, with a margin."""

    force: Estimate
    strength: float


def need_of(presses: Sequence[Press]) -> PressNeed:
    """What the button needs.

    Raises:
        ReadingsUnusable: none worked, none failed, or a weaker one worked where a stronger one did not.
    """
    worked, failed = ([press for press in presses if press.worked is wanted] for wanted in (True, False))
    if not worked or not failed:
        raise ReadingsUnusable(f"{len(worked)} presses worked and {len(failed)} did not; at least one of each is "
                               "needed. Order other strengths.")
    weakest, strongest = min(worked, key=_force), max(failed, key=_force)
    if weakest.force_n <= strongest.force_n:
        raise ReadingsUnusable(f"A press of {weakest.force_n:g} N worked and one of {strongest.force_n:g} N did not; "
                               "the key sits loosely, or the gauge slips. Fasten it, and begin again.")
    half = (weakest.force_n - strongest.force_n) / 2.0
    # The border lies anywhere between both.
    return PressNeed(Estimate(strongest.force_n + half, half / math.sqrt(3.0), math.inf),
                     min(1.0, MARGIN * weakest.strength))


def _force(press: Press) -> float:
    return press.force_n
