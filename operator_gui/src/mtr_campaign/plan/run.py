"""One simulated test of a campaign: kernel, scenario, settings, and the digest that identifies it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import hashlib
import json
import pathlib
from dataclasses import dataclass
from typing import Any, Mapping, Union

from mtr_operator import __version__

# Value of a setting in a plan.
Value = Union[float, int, str, bool]
_DIGITS = 16


@dataclass(frozen=True)
class Run:
    """Attributes: settings: values by their names, see kernels/order.py."""

    kernel: str
    scenario: str
    settings: Mapping[str, Value]

    @property
    def digest(self) -> str:
        """Identity of a test: depends on settings, software version, and the content of a custom Car file."""
        text = json.dumps({**self.to_document(), "software": __version__, **self._files()}, sort_keys=True,
                          allow_nan=False)
        return hashlib.sha256(text.encode("utf-8")).hexdigest()[:_DIGITS]

    def _files(self) -> dict[str, str]:
        path = pathlib.Path(str(self.settings.get("car", "")))
        # An unreadable file is reported by the kernel.
        with contextlib.suppress(OSError):
            if path.suffix == ".yaml":
                return {"car_file": hashlib.sha256(path.read_bytes()).hexdigest()}
        return {}

    def to_document(self) -> dict[str, Any]:
        """Plain values."""
        return {"kernel": self.kernel, "scenario": self.scenario, "settings": dict(self.settings)}


def run_from(document: Mapping[str, Any]) -> Run:
    """Restore a run from its document."""
    return Run(document["kernel"], document["scenario"], document["settings"])
