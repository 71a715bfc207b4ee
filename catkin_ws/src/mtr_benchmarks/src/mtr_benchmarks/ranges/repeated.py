"""Ten campaigns on one Car that differ only in noise, phase and speed; their lines should agree within the
intervals."""
# SPDX-License-Identifier: Apache-2.0
import itertools
from typing import List

from mtr_operator.domain.estimation.interval import difference_holds

from .result import LineFound

CAMPAIGNS = 10
# Slow and fast pass of Autolock for each campaign.
SPEEDS_MPS = ((0.1, 0.4), (0.08, 0.35), (0.12, 0.45), (0.1, 0.5), (0.15, 0.6))


def pairs_agree(campaigns: List[List[LineFound]]) -> List[bool]:
    """Return for each pair of campaigns and each line whether they agree."""
    return [difference_holds(first.found, second.found) for one, other in itertools.combinations(campaigns, 2)
            for first, second in zip(one, other)]
