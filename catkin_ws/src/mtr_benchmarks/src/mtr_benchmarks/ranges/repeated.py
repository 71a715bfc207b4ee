"""Ten campaigns on one Car that differ in noise, phase and speed only: do the lines agree within their intervals?"""
# SPDX-License-Identifier: Apache-2.0
import itertools
from typing import List

from mtr_operator.domain.estimation.interval import difference_holds

from .result import LineFound

CAMPAIGNS = 10
# Of Autolock: slow and fast pass of each campaign.
SPEEDS_MPS = ((0.1, 0.4), (0.08, 0.35), (0.12, 0.45), (0.1, 0.5), (0.15, 0.6))


def pairs_agree(campaigns: List[List[LineFound]]) -> List[bool]:
    """Of each pair of campaigns and each line."""
    return [difference_holds(first.found, second.found) for one, other in itertools.combinations(campaigns, 2)
            for first, second in zip(one, other)]
