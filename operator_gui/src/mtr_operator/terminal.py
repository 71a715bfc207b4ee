"""Lines on the terminal: a text of a received file neither controls the terminal nor begins a line of its own."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
from typing import TextIO

from mtr_operator.domain.results.document import shown_text


def show(text: object, stream: TextIO | None = None) -> None:
    """Print a text on one line, with its control characters replaced; stream: standard output by default."""
    print(shown_text(str(text)), file=stream or sys.stdout, flush=True)


def show_error(text: object) -> None:
    """The same on standard error."""
    show(text, sys.stderr)
