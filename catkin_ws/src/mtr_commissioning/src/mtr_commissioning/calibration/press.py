"""Required strength of a press: between the strongest failure and the weakest reliable success."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Sequence

from .readings import Estimate, ReadingsUnusable

# Factor for variations of the key's position and the supply of the servo.
MARGIN = 1.25


@dataclass(frozen=True)
class Press:
    """One press. strength: 0 to 1, as ordered. force_n: reading of a gauge in place of the key, N. worked: the button
    was pressed."""

    strength: float
    force_n: float
    worked: bool


@dataclass(frozen=True)
class PressNeed:
    """Requirement of the button. force: N. strength: minimum order, with a margin."""

    force: Estimate
    strength: float


def need_of(presses: Sequence[Press]) -> PressNeed:
    """Return the requirement of the button.

    Raises:
        ReadingsUnusable: none worked, none failed, or a weaker press worked while a stronger one failed.
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
    # The threshold is anywhere between both.
    return PressNeed(Estimate(strongest.force_n + half, half / math.sqrt(3.0), math.inf),
                     min(1.0, MARGIN * weakest.strength))


def _force(press: Press) -> float:
    return press.force_n
