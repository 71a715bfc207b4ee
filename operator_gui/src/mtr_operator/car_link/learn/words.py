"""Sentences on the findings; in English, as all sentences outside the window."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterator

from mtr_operator.domain.ports import LockState

from .bits import BITS_PER_BYTE
from .counters import Field
from .database_names import DatabaseNames
from .findings import Candidate, Findings

HEADINGS = ("identifier", "bits", "locked", "unlocked", "followed", "later by", "cycle", "besides")
# With more bits than this following by chance, a proposal is a guess.
MAX_BY_CHANCE = 0.1
_MS_PER_S = 1000.0


def cells(candidate: Candidate, stays: int, names: DatabaseNames | None = None) -> tuple[str, ...]:
    """Return one row of the table, see HEADINGS. names: supply the name in the last cell."""
    can_id, is_extended = candidate.id
    lag = "-" if candidate.lag_s is None else f"{candidate.lag_s * _MS_PER_S:.0f} ms"
    cycle = f"{candidate.cycle_s * _MS_PER_S:.0f} ms" if candidate.is_cyclic else "-"
    return (f"{can_id:0{8 if is_extended else 3}X}", place(candidate.field),
            str(candidate.values[LockState.LOCKED]), str(candidate.values[LockState.UNLOCKED]),
            f"{candidate.followed}/{stays}", lag, cycle, ", ".join(besides(candidate, names)))


def place(field: Field) -> str:
    """Return byte and bits, such as 0.4 or 0.4-6."""
    low = field.start % BITS_PER_BYTE
    return f"{field.byte}.{low}" if field.width == 1 else f"{field.byte}.{low}-{low + field.width - 1}"


def besides(candidate: Candidate, names: DatabaseNames | None = None) -> Iterator[str]:
    """Yield the name in a database, and the other contents of the message."""
    named = None if names is None else names.named(candidate)
    if named is not None:
        yield f"{named.message} {named.signal}"
    if candidate.counter is not None:
        yield f"counter {place(candidate.counter)}"
    if candidate.changes_counter is not None:
        yield f"counts changes {place(candidate.changes_counter)}"
    if candidate.sum_byte is not None:
        yield f"check sum in byte {candidate.sum_byte}"
    if candidate.extra:
        yield f"{candidate.extra} more changes"
    if not candidate.is_cyclic:
        yield "not cyclic"


def unnamed(findings: Findings, names: DatabaseNames | None) -> str:
    """Return a sentence if a database lacks the proposed bits; else empty."""
    if names is None or findings.best is None or names.named(findings.best) is not None:
        return ""
    return f"The CAN database {names.path} has no signal where it was found; the profile gets a database of its own."


def doubts(findings: Findings) -> tuple[str, ...]:
    """Return sentences on doubts about the proposal; empty without any."""
    told = []
    sure = [each for each in findings.candidates if each.followed == findings.stays]
    others = {each.id for each in sure} - {sure[0].id} if sure else set()
    if others:
        told.append(f"{len(others)} more messages followed all prompts as well, such as lights or mirrors; the one "
                    "that came first is proposed. Compare it with the Car's documents.")
    if findings.by_chance > MAX_BY_CHANCE:
        told.append(f"If what stands still between the prompts were chance, {findings.by_chance:.1f} bits would follow "
                    "all of them; more prompts make it surer.")
    if sure and sure[0].extra:
        told.append("What is proposed also changed when nobody was asked to act; repeat it, and act only when asked.")
    return tuple(told)
