"""How often the right signal is learned from a bus at full load, wherever it lies and whatever is beside it."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import random
from dataclasses import dataclass
from typing import Callable, Iterator, List

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.learn.findings import Findings, findings_of
from mtr_operator.car_link.learn.session import LearnSession, Stage
from mtr_operator.domain.errors import NothingLearned
from mtr_operator.domain.ports import LockState

# 500 kbit/s carry so many frames of 8 bytes a second, without stuffed bits.
_FRAMES_PER_S = 4500.0
_CYCLES_S = (0.01, 0.02, 0.02, 0.05, 0.1, 0.1, 0.2, 0.5, 1.0)
_STEP_S = 0.01
# A person reads, acts and answers.
_ACTS_S, _ANSWERS_S = 0.6, 1.3
_BYTES = 8
# Of the background's bytes: still, counters, noise of a sensor's low bits, drift, a state that toggles now and then.
_KINDS = ("still", "still", "counter", "noise", "drift", "toggle")
_TOGGLE_PER_S = 0.05


@dataclass
class _Message:
    """cycle_s, phase_s: when it comes. bytes_of: its bytes at a time, by the count of its frames."""

    can_id: int
    cycle_s: float
    bytes_of: List[Callable[[float, int], int]]
    due_s: float
    count: int = 0

    def frame(self, now_s: float) -> CanFrame:
        self.count += 1
        self.due_s += self.cycle_s
        return CanFrame(self.can_id, False, bytes(each(now_s, self.count) for each in self.bytes_of), now_s)


def is_found(seed: int, prompts: int = 10) -> bool:
    """True when the first proposal is the signal that was hidden."""
    chance = random.Random(seed)
    locked = [True]
    messages = list(_background(chance))
    hidden = chance.choice([each for each in messages if each.cycle_s <= 0.5])
    place, bit = chance.randrange(_BYTES), chance.randrange(_BYTES)
    when_locked, former = chance.random() < 0.5, hidden.bytes_of[place]
    hidden.bytes_of[place] = lambda now_s, count: (
        former(0.0, 0) & ~(1 << bit) | (locked[0] is when_locked) << bit)
    try:
        best = _findings(messages, locked, prompts).proposal
    except NothingLearned:
        return False
    position = _BYTES * place + bit
    return best.id[0] == hidden.can_id and best.field.start <= position < best.field.start + best.field.width


def _findings(messages: List[_Message], locked: List[bool], prompts: int) -> Findings:
    session = LearnSession(prompts)
    session.begin(0.0)
    asked_s, before = 0.0, Stage.REST
    for now_s in (_STEP_S * step for step in itertools.count()):
        stage = session.tick(now_s)
        if stage is Stage.COMPLETE:
            return findings_of(session.recording)
        if stage is Stage.ASKED:
            asked_s = asked_s if before is stage else now_s
            if now_s >= asked_s + _ACTS_S:
                locked[0] = session.wanted is LockState.LOCKED
            if now_s >= asked_s + _ANSWERS_S:
                session.done(now_s)
        before = stage
        for message in messages:
            while message.due_s <= now_s:
                session.recording.frame(message.frame(now_s))
    raise AssertionError("The session has no end.")


def _background(chance: random.Random) -> Iterator[_Message]:
    """As many messages as fill the bus."""
    frames_per_s = 0.0
    for can_id in chance.sample(range(0x80, 0x700), 500):
        cycle_s = chance.choice(_CYCLES_S)
        frames_per_s += 1.0 / cycle_s
        if frames_per_s > _FRAMES_PER_S:
            return
        yield _Message(can_id, cycle_s, [_byte(chance) for _ in range(_BYTES)], chance.uniform(0.0, cycle_s))


def _byte(chance: random.Random) -> Callable[[float, int], int]:
    kind, base = chance.choice(_KINDS), chance.randrange(256)
    own = random.Random(base + chance.randrange(1 << 30))
    if kind == "counter":
        return lambda _, count: count % 256
    if kind == "noise":
        return lambda *_: base & 0xFC | own.randrange(4)
    if kind == "drift":
        return lambda now_s, _: (base + int(now_s / 3.0)) % 256
    if kind == "toggle":
        phase_s, period_s = own.uniform(0.0, 20.0), own.uniform(0.5, 2.0) / _TOGGLE_PER_S
        return lambda now_s, _: base ^ int((now_s + phase_s) / period_s) % 2
    return lambda *_: base
