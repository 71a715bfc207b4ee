"""One simulated test of a campaign: kernel, scenario and settings, and the digest by which it is known."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import hashlib
import json
import pathlib
from dataclasses import dataclass
from typing import Any, Mapping, Union

from mtr_operator import __version__

# A value of a setting as it stands in a plan.
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
        """The same for the same test by the same version of the software; a Car's own file counts by its content."""
        text = json.dumps({**self.to_document(), "software": __version__, **self._files()}, sort_keys=True,
                          allow_nan=False)
        return hashlib.sha256(text.encode("utf-8")).hexdigest()[:_DIGITS]

    def _files(self) -> dict[str, str]:
        path = pathlib.Path(str(self.settings.get("car", "")))
        # One that cannot be read is told by whoever runs it.
        with contextlib.suppress(OSError):
            if path.suffix == ".yaml":
                return {"car_file": hashlib.sha256(path.read_bytes()).hexdigest()}
        return {}

    def to_document(self) -> dict[str, Any]:
        """Plain values."""
        return {"kernel": self.kernel, "scenario": self.scenario, "settings": dict(self.settings)}


def run_from(document: Mapping[str, Any]) -> Run:
    """The run of a document of to_document()."""
    return Run(document["kernel"], document["scenario"], document["settings"])
