"""Content of a limits file: the requirements, and the time for further measurements on inconclusive lines."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any

from .requirement import Requirement

DEFAULT_FURTHER_TIME_S = 600.0


@dataclass(frozen=True)
class Limits:
    """Limits of a test. Attributes: further_time_limit_s: robot time for inconclusive lines after the last line."""

    requirements: tuple[Requirement, ...]
    further_time_limit_s: float = DEFAULT_FURTHER_TIME_S

    def to_document(self) -> dict[str, Any]:
        """Return plain values as in the file; defaults are omitted."""
        return {"limits": [_entry(requirement) for requirement in self.requirements],
                "further_time_limit_s": self.further_time_limit_s}


def _entry(requirement: Requirement) -> dict[str, Any]:
    defaults = {item.name: item.default for item in dataclasses.fields(Requirement)}
    values = {name: getattr(requirement, name) for name in defaults}
    return {name: list(value) if isinstance(value, tuple) else value for name, value in values.items()
            if value is not None and value != defaults[name]}
