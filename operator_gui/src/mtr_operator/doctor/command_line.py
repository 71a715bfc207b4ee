"""The command that says what this computer lacks."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.station.checks.finding import State
from mtr_operator.station.settings_file import SettingsStore, default_path

from .computer import Computer, computer_findings
from .files import file_findings
from .finding import SIGNS

_SIGNS = {**SIGNS, State.BAD: "missing"}


def doctor(computer: Computer | None = None) -> bool:
    """Print a line for each thing that was looked at. True when nothing is missing."""
    found = [*computer_findings(computer or Computer()), *file_findings(SettingsStore(default_path()))]
    for finding in found:
        print(finding.line(_SIGNS))
    missing = sum(finding.state is State.BAD for finding in found)
    print(f"{missing} of {len(found)} are missing." if missing else "Nothing is missing.")
    return not missing
