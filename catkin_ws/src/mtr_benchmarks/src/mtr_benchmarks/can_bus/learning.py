"""Measures how often learning finds the right signal on a fully loaded bus, at any position and next to any traffic."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import pathlib
import random
from typing import List, Optional

from mtr_operator.car_link.learn.findings import Findings, findings_of
from mtr_operator.car_link.learn.session import LearnSession, Stage
from mtr_operator.domain.errors import NothingLearned
from mtr_operator.domain.ports import LockState

from .traffic import TrafficMessage, made_traffic, recorded_traffic

# Frames of 8 bytes per second on a bus of 500 kbit/s, without stuff bits.
_FRAMES_PER_S = 4500.0
# Longest cycle of a message that carries a state.
_SLOWEST_S = 0.5
_STEP_S = 0.01
# Reaction of a person to a prompt: delay of the action and of the answer.
_ACTS_S, _ANSWERS_S = 0.6, 1.3


def is_found(seed: int, prompts: int = 10, log: Optional[pathlib.Path] = None) -> bool:
    """Return True if the first proposal is the hidden signal. log: recording of a car, used instead of random
    traffic."""
    chance = random.Random(seed)
    locked = [True]
    messages = list(made_traffic(chance, _FRAMES_PER_S) if log is None
                    else recorded_traffic(log, chance, _FRAMES_PER_S))
    hidden = chance.choice([each for each in messages if each.cycle_s <= _SLOWEST_S and each.length])
    place, bit = chance.randrange(hidden.length), chance.randrange(8)
    when_locked = chance.random() < 0.5
    hidden.hide(place, bit, lambda: locked[0] is when_locked)
    try:
        best = _findings(messages, locked, prompts).proposal
    except NothingLearned:
        return False
    position = 8 * place + bit
    return best.id[0] == hidden.can_id and best.field.start <= position < best.field.start + best.field.width


def _findings(messages: List[TrafficMessage], locked: List[bool], prompts: int) -> Findings:
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
