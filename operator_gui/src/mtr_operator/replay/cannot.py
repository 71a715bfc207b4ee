"""Error of a test that cannot be recomputed."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.errors import OperatorError


class CannotReplay(OperatorError):
    """The recording is insufficient; the text names the missing data."""
