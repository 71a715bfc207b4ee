"""Identifiers of the diagnostics of an ECU."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Addresses:
    """Identifiers of an ECU's diagnostics, both extended or neither."""

    request_id: int
    response_id: int
    is_extended: bool = False
