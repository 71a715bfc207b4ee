"""Writes what was learned as a profile of the Car: a YAML file, and beside it a CAN database of its one message."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
import re

from mtr_operator.domain.errors import InvalidParameter, OutputError
from mtr_operator.domain.ports import LockState
from mtr_operator.storage.atomic import write_bytes

from ..profile import load_profile
from .counters import Field
from .findings import Candidate, Findings

_NAME = re.compile(r"[A-Za-z0-9_\-]+\.yaml")
_EXTENDED_BIT = 0x8000_0000
_SIGNAL, _ALIVE, _CHANGES = "LockState", "AliveCounter", "ChangeCounter"


def check_name(path: pathlib.Path) -> None:
    """Raise InvalidParameter for a path that is no NAME.yaml, OutputError when it or its database is there already."""
    if not _NAME.fullmatch(path.name):
        raise InvalidParameter(f"The profile is called {path.name}; allowed are letters, digits, - and _, and .yaml at "
                               "the end.")
    for each in (path, path.with_suffix(".dbc")):
        if each.exists():
            raise OutputError(f"The file {each} is there already; choose another name.")


def write_profile(path: pathlib.Path, findings: Findings) -> None:
    """Write NAME.yaml and NAME.dbc, and read them back as a test would; see check_name for what is refused.

    OutputError when they cannot be written, NothingLearned when nothing followed the locks.
    """
    best, database = findings.proposal, path.with_suffix(".dbc")
    check_name(path)
    write_bytes(database, _database(best).encode("ascii"))
    write_bytes(path, _profile(database.name, best, findings).encode("ascii"))
    load_profile(str(path))


def message_name(candidate: Candidate) -> str:
    """Such as Message_320: what the identifier of an unknown message is called."""
    return f"Message_{candidate.id[0]:X}"


def _database(best: Candidate) -> str:
    can_id, is_extended = best.id
    fields = {_SIGNAL: best.field, _ALIVE: best.counter, _CHANGES: best.changes_counter}
    signals = [_signal(name, field) for name, field in fields.items() if field is not None]
    head = ['VERSION ""', "", "NS_ :", "", "BS_:", "", "BU_: Car Tester", "",
            f"BO_ {can_id | (_EXTENDED_BIT if is_extended else 0)} {message_name(best)}: {best.length} Car"]
    values = " ".join(f'{raw} "{state.value}"' for state, raw in sorted(best.values.items(), key=lambda item: item[1]))
    tail = ["", f"VAL_ {can_id | (_EXTENDED_BIT if is_extended else 0)} {_SIGNAL} {values} ;", ""]
    return "\n".join([*head, *signals, *tail])


def _signal(name: str, field: Field) -> str:
    return f' SG_ {name} : {field.start}|{field.width}@1+ (1,0) [0|{(1 << field.width) - 1}] "" Tester'


def _profile(database: str, best: Candidate, findings: Findings) -> str:
    """Lines of the profile; what was not seen is left out, and holds by default."""
    lines = [f"# Learned from {findings.frames} frames: followed {best.followed} of {findings.stays} prompts.",
             "# Try it with the Car's live view before a test, and add what the Car tells beyond this.",
             "description: Car learned from its bus", f"database: {database}", f"message: {message_name(best)}",
             f"signal: {_SIGNAL}", "states:",
             *(f"  {best.values[state]}: {state.value}" for state in (LockState.LOCKED, LockState.UNLOCKED)),
             f"cycle_time_s: {max(round(best.cycle_s, 3), 0.001):g}", f"sent_on_change: {str(best.on_change).lower()}"]
    lines += [f"alive_signal: {_ALIVE}"] if best.counter else []
    lines += [f"command_signal: {_CHANGES}"] if best.changes_counter else []
    return "\n".join([*lines, ""])
