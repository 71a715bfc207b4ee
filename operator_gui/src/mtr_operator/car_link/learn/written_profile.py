"""Writes the findings as a profile of the Car: a YAML file, and a database unless one exists."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import json
import pathlib
import re
from typing import Mapping, Sequence

from mtr_operator.domain.errors import InvalidParameter, NothingLearned, OutputError
from mtr_operator.domain.ports import LockState
from mtr_operator.storage.atomic import write_bytes
from mtr_operator.storage.inside import inside

from ..further.entries import database_folders
from ..profile import CarProfile, load_profile
from .bits import field_of
from .counters import Field
from .database_names import DatabaseNames, Named
from .findings import Candidate, Findings

_NAME = re.compile(r"[A-Za-z0-9_\-]+\.yaml")
_EXTENDED_BIT = 0x8000_0000
_MIN_COUNTER_BITS = 2
_SIGNAL, _ALIVE, _CHANGES = "LockState", "AliveCounter", "ChangeCounter"


def check_name(path: pathlib.Path, has_database: bool = False) -> None:
    """Raise InvalidParameter for a path that is not NAME.yaml, OutputError if it or its database exists.

    has_database: the profile uses an existing one.
    """
    if not _NAME.fullmatch(path.name):
        raise InvalidParameter(f"The profile is called {path.name}; allowed are letters, digits, - and _, and .yaml at "
                               "the end.")
    for each in (path,) if has_database else (path, path.with_suffix(".dbc")):
        if each.exists():
            raise OutputError(f"The file {each} is there already; choose another name.")


def write_profile(path: pathlib.Path, findings: Findings, names: DatabaseNames | None = None) -> None:
    """Write NAME.yaml, and NAME.dbc unless names knows the signal; read them back as a test would.

    OutputError if they cannot be written, see check_name; NothingLearned if no bit followed the locks.
    """
    best, database = findings.proposal, path.with_suffix(".dbc")
    named = None if names is None else names.named(best)
    check_name(path, has_database=named is not None)
    if names is None or named is None:
        write_bytes(database, _database(best).encode("ascii"))
        lines = _own_entries(database.name, best)
    else:
        lines = _named_entries(path.parent, names, named, best)
    write_bytes(path, _profile(lines, best, findings).encode("utf-8"))
    _check(load_profile(str(path)), best)


def _check(profile: CarProfile, best: Candidate) -> None:
    """Raise NothingLearned if a test would not understand the frames from which the profile was learned."""
    decode = profile.decoder()
    readings = [(state, decode(*best.id, data)) for state, data in best.data]
    wrong = sum(reading is None or reading.state is not state for state, reading in readings)
    if wrong:
        raise NothingLearned(f"The profile {profile.name} was written, and does not understand {wrong} of the "
                             f"{len(readings)} frames from which it was learned; learn again with more prompts.")


def message_name(candidate: Candidate) -> str:
    """Return the name of an unknown message by its identifier, such as Message_320."""
    return f"Message_{candidate.id[0]:X}"


def _database(best: Candidate) -> str:
    can_id, is_extended = best.id
    fields = {_SIGNAL: best.field, _ALIVE: best.counter, _CHANGES: _moving(best)}
    limits = {_ALIVE: best.counter_values}
    signals = [_signal(name, field, limits.get(name)) for name, field in fields.items() if field is not None]
    head = ['VERSION ""', "", "NS_ :", "", "BS_:", "", "BU_: Car Tester", "",
            f"BO_ {can_id | (_EXTENDED_BIT if is_extended else 0)} {message_name(best)}: {best.length} Car"]
    values = " ".join(f'{raw} "{state.value}"' for state, raw in sorted(best.values.items(), key=lambda item: item[1]))
    tail = ["", f"VAL_ {can_id | (_EXTENDED_BIT if is_extended else 0)} {_SIGNAL} {values} ;", ""]
    return "\n".join([*head, *signals, *tail])


def _signal(name: str, field: Field, values: tuple[int, int] | None) -> str:
    low, high = values or (0, (1 << field.width) - 1)
    return f' SG_ {name} : {field.start}|{field.width}@1+ (1,0) [{low}|{high}] "" Tester'


def _moving(best: Candidate) -> Field | None:
    """Return the counter of changes without the highest bits that never changed: they may not belong to it."""
    field = best.changes_counter
    if field is None:
        return None
    values = [field_of(int.from_bytes(data, "little"), *field) for _, data in best.data]
    width = max((value ^ values[0]).bit_length() for value in values)
    return Field(field.start, max(width, _MIN_COUNTER_BITS))


def _profile(entries: Sequence[str], best: Candidate, findings: Findings) -> str:
    """Return the lines of the profile; properties that were not observed are omitted and keep their defaults."""
    return "\n".join([
        f"# Learned from {findings.frames} frames: followed {best.followed} of {findings.stays} prompts.",
        "# Try it with the Car's live view before a test, and add what the Car tells beyond this.",
        "description: Car learned from its bus", *entries,
        f"cycle_time_s: {max(round(best.cycle_s, 3), 0.001):g}", f"sent_on_change: {str(best.on_change).lower()}", ""])


def _own_entries(database: str, best: Candidate) -> list[str]:
    lines = [f"database: {database}", f"message: {message_name(best)}", f"signal: {_SIGNAL}", *_states(best.values)]
    lines += [f"alive_signal: {_ALIVE}", *_alive_values(best)] if best.counter else []
    lines += [f"command_signal: {_CHANGES}"] if best.changes_counter else []
    return lines


def _named_entries(folder: pathlib.Path, names: DatabaseNames, named: Named, best: Candidate) -> list[str]:
    """Return the entries for an existing database. Names are quoted, because YAML may read a word as a different
    type."""
    lines = [f"database: {json.dumps(_name_for(folder, names.path), ensure_ascii=False)}",
             f"message: {json.dumps(named.message)}", f"signal: {json.dumps(named.signal)}", *_states(named.values)]
    moving = _moving(best)
    alive = names.counter(best, best.counter, best.counter)
    changes = names.counter(best, moving, best.changes_counter)
    lines += [f"alive_signal: {json.dumps(alive)}", *_alive_values(best)] if alive else []
    return [*lines, f"command_signal: {json.dumps(changes)}"] if changes else lines


def _alive_values(best: Candidate) -> list[str]:
    return [] if best.counter_values is None else [f"alive_values: {list(best.counter_values)}"]


def _states(values: Mapping[LockState, int]) -> list[str]:
    return ["states:", *(f"  {values[state]}: {state.value}" for state in (LockState.LOCKED, LockState.UNLOCKED))]


def _name_for(folder: pathlib.Path, path: pathlib.Path) -> str:
    """Return the name of a database in a profile in the folder. A database outside the folders of databases is copied
    next to the profile; OutputError if another file of that name exists."""
    for place in database_folders(folder):
        with contextlib.suppress(ValueError):
            return path.resolve().relative_to(place.resolve()).as_posix()
    copy, content = inside(folder, path.name), path.read_bytes()
    if copy.exists() and copy.read_bytes() != content:
        raise OutputError(f"The file {copy} is there already; choose another name.")
    write_bytes(copy, content)
    return copy.name
