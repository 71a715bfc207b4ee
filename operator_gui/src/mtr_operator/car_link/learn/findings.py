"""Ranks the bits of messages that follow the locks: one value while the Car was locked, the other while it was
unlocked."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import bisect
import dataclasses
import statistics
from dataclasses import dataclass
from typing import Iterator, Mapping, NamedTuple, Sequence

from mtr_operator.domain.errors import NothingLearned
from mtr_operator.domain.ports import LockState

from ..message_table import MessageId
from .bits import BITS_PER_BYTE, Held, changes, field_of, held, ones, still_bits
from .counters import Field, change_counter, check_sum, frame_counter
from .recording import Message, Recording, Stay

# Lower-ranked bits are more likely mirrors, lights and counters than the locks.
MAX_SHOWN = 20
# A profile needs a cyclic message, see profile.py.
_MAX_CYCLE_S = 10.0
# Frames that precede the next cyclic one by this part of the cycle are sent because of the change.
_EARLY = 0.25


@dataclass(frozen=True)
class Candidate:
    """Bits that followed the locks.

    id: of the message. field: the bits. values: of the field, by the state of the locks. cycle_s: of the message.
    followed: stays with the value of the other stays in that state. extra: further changes between the stays. lag_s:
    after the earliest candidate's change, median of all prompts; None if unknown.
    is_cyclic: the message is frequent enough for a profile. on_change: it is also sent at once.
    counter_values: lowest and highest value of counter, None for the full range of its bits.
    counter, changes_counter: bits of the same message that count its frames, and the changes; None without any.
    sum_byte: number of the check sum byte, None without one. data: of the message at the end of each stay.
    """

    id: MessageId
    length: int
    field: Field
    values: Mapping[LockState, int]
    followed: int
    extra: int
    cycle_s: float
    lag_s: float | None = None
    is_cyclic: bool = True
    on_change: bool = False
    counter: Field | None = None
    counter_values: tuple[int, int] | None = None
    changes_counter: Field | None = None
    sum_byte: int | None = None
    data: tuple[tuple[LockState, bytes], ...] = ()


class Findings(NamedTuple):
    """Result of a recording. candidates: the most likely one first. stays: their number. messages, frames: numbers of
    received ones.

    by_chance: expected number of bits that would follow every prompt if the bits that are constant between prompts were
    random.
    """

    candidates: tuple[Candidate, ...]
    stays: int
    messages: int
    frames: int
    by_chance: float

    @property
    def best(self) -> Candidate | None:
        """Candidate for a profile; None if no bit followed every prompt in a frequent message."""
        return next((each for each in self.candidates if each.followed == self.stays and each.is_cyclic), None)

    @property
    def proposal(self) -> Candidate:
        """Best candidate; NothingLearned states why there is none."""
        if self.frames == 0:
            raise NothingLearned("Nothing came over the bus; check bit rate, plug and whether the Car is awake.")
        if self.best is None:
            raise NothingLearned("No bit of any message followed all prompts; repeat it, and act only when asked. A "
                                 "Car that tells its locks on another bus cannot be learned from this one.")
        return self.best


def findings_of(recording: Recording) -> Findings:
    """Evaluate a complete recording."""
    messages, stays = recording.messages(), tuple(recording.stays)
    found: list[Candidate] = []
    coins = 0
    for message in messages:
        parts = held(message, stays)
        coins += _coins(parts)
        found += _candidates(message, parts, stays)
    ranked = sorted(_with_lags(found, messages, stays), key=_rank)
    return Findings(tuple(ranked[:MAX_SHOWN]), len(stays), len(messages), recording.count,
                    coins * 2.0 ** (1 - len(stays)))


def _rank(candidate: Candidate) -> tuple[object, ...]:
    lag_s = float("inf") if candidate.lag_s is None else candidate.lag_s
    return (-candidate.followed, not candidate.is_cyclic, candidate.extra, lag_s, candidate.cycle_s, candidate.id,
            candidate.field)


def _coins(parts: Sequence[Held]) -> int:
    """Return the number of bits that were constant in every stay, but not the same in all."""
    moved = 0
    for part in parts[1:]:
        moved |= part.value ^ parts[0].value
    return len(list(ones(moved & still_bits(parts))))


def _candidates(message: Message, parts: Sequence[Held], stays: Sequence[Stay]) -> Iterator[Candidate]:
    """Yield bits of a message that followed all prompts but at most one; neighbours that followed all are one field."""
    still = still_bits(parts)
    counting = change_counter(parts, message.length)
    scores = {bit: _followed(parts, stays, bit) for bit in ones(still)
              if counting is None or not counting.holds(bit)}
    sure = [bit for bit, score in scores.items() if score == len(stays)]
    nearly = [Field(bit, 1) for bit, score in scores.items() if score == len(stays) - 1]
    fields = [(field, len(stays)) for field in _joined(sure)] + [(field, len(stays) - 1) for field in nearly]
    if not fields:
        return
    cycle_s = _cycle(message)
    counted, data = frame_counter(message), tuple(_ends(message, stays))
    counter, counter_values = (None, None) if counted is None else counted
    for field, followed in fields:
        values = _values(parts, stays, field)
        moves = changes(message.samples, *field)
        yield Candidate(message.id, message.length, field, values, followed, max(len(moves) - len(stays), 0), cycle_s,
                        is_cyclic=cycle_s <= _MAX_CYCLE_S and _is_in_each(message, stays),
                        on_change=_is_sent_on_change(message, moves, cycle_s), counter=counter,
                        counter_values=counter_values,
                        changes_counter=counting, sum_byte=check_sum(message, counter), data=data)


def _ends(message: Message, stays: Sequence[Stay]) -> Iterator[tuple[LockState, bytes]]:
    """Yield the state and the newest data at the end of each stay; stays before the first frame are skipped."""
    times_s = [sample.time_s for sample in message.samples]
    for stay in stays:
        end = bisect.bisect_right(times_s, stay.end_s)
        if end:
            newest = message.samples[end - 1]
            yield stay.state, newest.value.to_bytes(newest.length, "little")


def _values(parts: Sequence[Held], stays: Sequence[Stay], field: Field) -> dict[LockState, int]:
    """Return the most frequent value of a field in each state."""
    return {state: statistics.mode(field_of(part.value, *field) for part, stay in zip(parts, stays)
                                   if stay.state is state) for state in dict.fromkeys(stay.state for stay in stays)}


def _followed(parts: Sequence[Held], stays: Sequence[Stay], bit: int) -> int:
    """Return the number of stays in which a bit had the usual value of that state; 0 for a bit that never changed."""
    is_one = [bool(part.value >> bit & 1) is (stay.state is LockState.UNLOCKED) for part, stay in zip(parts, stays)]
    return 0 if len({part.value >> bit & 1 for part in parts}) == 1 else max(sum(is_one), len(parts) - sum(is_one))


def _joined(bits: Sequence[int]) -> list[Field]:
    """Join neighbours within a byte to one field."""
    fields: list[Field] = []
    for bit in bits:
        last = fields[-1] if fields else None
        if last is not None and last.start + last.width == bit and bit % BITS_PER_BYTE:
            fields[-1] = Field(last.start, last.width + 1)
        else:
            fields.append(Field(bit, 1))
    return fields


def _cycle(message: Message) -> float:
    """Return the median time between two frames, in s; infinite without any."""
    times_s = [sample.time_s for sample in message.samples]
    gaps_s = [after - before for before, after in zip(times_s, times_s[1:])]
    return statistics.median(gaps_s) if gaps_s else float("inf")


def _is_in_each(message: Message, stays: Sequence[Stay]) -> bool:
    """Return True if the message is sent in each stay. One that is sent only on change would count as silent in a
    test."""
    return all(any(stay.begin_s <= sample.time_s <= stay.end_s for sample in message.samples) for stay in stays)


def _is_sent_on_change(message: Message, moves: Sequence[tuple[float, int]], cycle_s: float) -> bool:
    """Return True if frames with a change precede the next cyclic one."""
    if len(moves) < 2 or not 0.0 < cycle_s <= _MAX_CYCLE_S:
        return False
    before_s = {after.time_s: before.time_s for before, after in zip(message.samples, message.samples[1:])}
    early = [1.0 - (time_s - before_s[time_s]) / cycle_s for time_s, _ in moves[1:] if time_s in before_s]
    return bool(early) and statistics.median(early) > _EARLY


def _with_lags(found: Sequence[Candidate], messages: Sequence[Message], stays: Sequence[Stay]) -> list[Candidate]:
    """Return the candidates with their delay after the earliest candidate that followed every prompt."""
    by_id = {message.id: message for message in messages}
    answers = [_answers(by_id[each.id], each, stays) for each in found]
    firsts = [min((answer[index] for each, answer in zip(found, answers)
                   if each.followed == len(stays) and index in answer), default=None) for index in range(len(stays))]
    lags = [[time_s - first for index, time_s in answer.items() if (first := firsts[index]) is not None]
            for answer in answers]
    return [dataclasses.replace(each, lag_s=statistics.median(lag) if lag else None) for each, lag in zip(found, lags)]


def _answers(message: Message, candidate: Candidate, stays: Sequence[Stay]) -> dict[int, float]:
    """Return the times at which the field got its value in a stay, by the number of the stay; only stays with a
    change."""
    moves = changes(message.samples, *candidate.field)
    answers = {}
    for index, stay in enumerate(stays):
        times_s = [time_s for time_s, value in moves[1:]
                   if stay.asked_s <= time_s <= stay.end_s and value == candidate.values[stay.state]]
        if times_s:
            answers[index] = times_s[0]
    return answers
