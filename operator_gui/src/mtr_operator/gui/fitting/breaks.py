"""Long names of files have no blank at which a row of text could end."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re

_BREAK = "\N{ZERO WIDTH SPACE}"
_AFTER = re.compile(r"(?<=[/\\_])(?=\S)")


def breakable(text: str) -> str:
    """The text, with places after slashes and underscores where a row may end."""
    return _AFTER.sub(_BREAK, text)
