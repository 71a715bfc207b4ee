"""Why a test cannot be computed anew."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.errors import OperatorError


class CannotReplay(OperatorError):
    """What was recorded does not suffice; the text says what is missing."""
