"""Decisions of handle requests at the nominal border, compared with the true probability of a decision inside."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
from typing import Iterable, List

from .distance import Comparison
from .results import optional_number, rows_of


def border_table(path: pathlib.Path, comparisons: Iterable[Comparison]) -> List[str]:
    """Return a line for each axis with requests at its nominal border; empty without one, or without the Car's
    model."""
    shares = {each.measured.line: each.expected.border_share for each in comparisons}
    lines = []
    for row in rows_of(path):
        inside, outside, border_m = (optional_number(row, name, path)
                                     for name in ("inside_at_border", "outside_at_border", "border_m"))
        share = shares.get(row["axis"], math.nan)
        if inside + outside > 0 and math.isfinite(share):
            lines.append(f"{row['axis']:>4} {border_m:8.3f}  {inside:6.0f} of {inside + outside:<6.0f} {share:11.3f}")
    return ["line border m  inside at border  truly inside", *lines] if lines else []
