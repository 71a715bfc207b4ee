"""Command that reports missing requirements of this computer."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.station.checks.finding import State
from mtr_operator.station.settings_file import SettingsStore, default_path

from .computer import Computer, computer_findings
from .files import file_findings
from .finding import SIGNS

_SIGNS = {**SIGNS, State.BAD: "missing"}


def doctor(computer: Computer | None = None) -> bool:
    """Print a line for each check. Return True if all passed."""
    found = [*computer_findings(computer or Computer()), *file_findings(SettingsStore(default_path()))]
    for finding in found:
        print(finding.line(_SIGNS))
    missing = sum(finding.state is State.BAD for finding in found)
    print(f"{missing} of {len(found)} are missing." if missing else "Nothing is missing.")
    return not missing
