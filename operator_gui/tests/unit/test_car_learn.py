"""A Car's profile learned from its bus: on Cars of known databases, on noise, and on what only looks like locks."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import random

import cantools
import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.fake_message import DemoLockMessage
from mtr_operator.car_link.learn import session as course
from mtr_operator.car_link.learn.counters import Field
from mtr_operator.car_link.learn.findings import findings_of
from mtr_operator.car_link.learn.session import LearnSession, Stage
from mtr_operator.car_link.learn.words import cells, doubts, place
from mtr_operator.car_link.learn.written_profile import write_profile
from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.domain.errors import InvalidParameter, NothingLearned, OutputError
from mtr_operator.domain.ports import LockState

THINKS_S, STEP_S = 1.3, 0.02


class Sender:
    """A message of a bus. data(is_locked, count): bytes of a frame; cycle_s; delay_s: after the locks; on_change: comes
    at once, and never else when cycle_s is None."""

    def __init__(self, can_id, data, cycle_s=0.1, *, delay_s=0.0, on_change=False, is_extended=False):
        self.can_id, self.data, self.cycle_s, self.delay_s = can_id, data, cycle_s, delay_s
        self.on_change, self.is_extended = on_change, is_extended
        self.count, self.due_s, self.told = 0, 0.0, True

    def frames(self, now_s, moved_s, is_locked):
        knows = is_locked if now_s >= moved_s + self.delay_s else not is_locked
        is_new, self.told = self.on_change and knows is not self.told, knows
        if not is_new and (self.cycle_s is None or now_s < self.due_s):
            return []
        self.due_s = now_s + self.cycle_s if self.cycle_s else 0.0
        self.count += 1
        return [CanFrame(self.can_id, self.is_extended, self.data(knows, self.count), now_s)]


def learned(*senders, prompts=course.DEFAULT_PROMPTS, forgets=()):
    """What is found when a person does as asked, but for some prompts that are forgotten."""
    session = LearnSession(prompts)
    session.begin(0.0)
    is_locked, moved_s, asked_s, before = True, -10.0, 0.0, Stage.REST
    for now_s in (step * STEP_S for step in itertools.count()):
        stage = session.tick(now_s)
        if stage is Stage.COMPLETE:
            return findings_of(session.recording)
        if stage is Stage.ASKED:
            asked_s = now_s if before is not Stage.ASKED else asked_s
            wants_locked = session.wanted is LockState.LOCKED
            if now_s >= asked_s + 0.6 and is_locked is not wants_locked and session.number not in forgets:
                is_locked, moved_s = wants_locked, now_s
            if now_s >= asked_s + THINKS_S:
                session.done(now_s)
        before = stage
        for sender in senders:
            for frame in sender.frames(now_s, moved_s, is_locked):
                session.recording.frame(frame)


def demo_sender():
    message = DemoLockMessage()

    def data(is_locked, _count):
        message.is_locked = is_locked
        return message.next()
    return Sender(0x320, data, 0.02)


def honest_sender():
    database = cantools.database.load_file(str(PROFILE_FOLDER / "mtr_honest_car.dbc"))
    message, events = database.get_message_by_name("LockStatus"), [True]

    def data(is_locked, count):
        if is_locked is not events[-1]:
            events.append(is_locked)
        return bytes(message.encode({"LockState": 0 if is_locked else 2, "LockCause": 2,
                                     "EventCounter": len(events) - 1, "AliveCounter": count % 16}))
    return Sender(0x411, data, 0.2)


def background(seed=1):
    """A running clock, a noisy sensor, a sensor that seldom moves, and a message that never changes."""
    chance = random.Random(seed)
    return [Sender(0x100, lambda _, count: count.to_bytes(8, "little")),
            Sender(0x1A0, lambda *_: bytes([chance.randrange(256), 7, chance.randrange(4)]), 0.04),
            Sender(0x2F0, lambda _, count: bytes([4, 118 + count // 90])), Sender(0x700, lambda *_: bytes(8), 0.5)]


def test_demo_car_is_learned_with_its_counters():
    found = learned(*background(), demo_sender())
    best = found.best
    assert best.id == (0x320, False)
    assert (best.field, best.values) == (Field(0, 1), {LockState.LOCKED: 0, LockState.UNLOCKED: 1})
    assert best.counter == Field(16, 4)
    assert best.changes_counter == Field(8, 8)
    assert best.cycle_s == pytest.approx(0.02)
    assert not best.on_change and best.followed == 10


def test_honest_car_is_learned():
    best = learned(*background(), honest_sender()).best
    assert (best.id, best.field, best.values) == ((0x411, False), Field(1, 1),
                                                  {LockState.LOCKED: 0, LockState.UNLOCKED: 1})
    assert (best.counter, best.changes_counter) == (Field(16, 4), Field(8, 8))


def test_neighbouring_bits_are_one_signal_and_a_check_sum_is_recognised():
    def data(is_locked, count):
        head = bytes([0, (0b01 if is_locked else 0b10) << 3, 0xF0 | count % 16])
        return head + bytes([(sum(head) ^ 0x5A) % 256])
    best = learned(Sender(0x18DA10F1, data, is_extended=True)).best
    assert best.id == (0x18DA10F1, True)
    assert (best.field, best.values) == (Field(11, 2), {LockState.LOCKED: 1, LockState.UNLOCKED: 2})
    assert (best.counter, best.sum_byte) == (Field(16, 4), 3)


def test_nothing_follows_on_a_bus_without_locks():
    found = learned(*background())
    assert found.best is None
    with pytest.raises(NothingLearned, match="repeat it"):
        assert found.proposal


def test_silent_bus_says_so():
    with pytest.raises(NothingLearned, match="Nothing came over the bus"):
        assert learned().proposal


def test_earliest_of_several_followers_is_proposed_and_the_others_are_told():
    lights = Sender(0x200, lambda is_locked, _: bytes([0x80 if is_locked else 0]), 0.02, delay_s=0.24)
    found = learned(lights, demo_sender())
    assert found.best.id == (0x320, False)
    assert [each.id[0] for each in found.candidates] == [0x320, 0x200]
    assert found.candidates[1].lag_s == pytest.approx(0.24, abs=0.03)
    assert any("1 more messages followed" in doubt for doubt in doubts(found))


def test_message_that_comes_only_with_changes_is_shown_and_not_proposed():
    found = learned(Sender(0x333, lambda is_locked, _: bytes([is_locked]), None, on_change=True))
    assert [each.is_cyclic for each in found.candidates] == [False]
    assert found.best is None


def test_message_that_is_also_sent_at_once_is_known_as_such():
    # A cycle that does not divide the time between two prompts.
    best = learned(Sender(0x333, lambda is_locked, _: bytes([is_locked]), 0.46, on_change=True)).best
    assert best.on_change
    assert best.cycle_s == pytest.approx(0.46, abs=0.03)


def test_forgotten_prompt_leaves_a_follower_of_all_but_one_and_no_proposal():
    # The first one asks for what is so already; without the last one the Car stays locked.
    found = learned(demo_sender(), forgets=(10,))
    assert {each.followed for each in found.candidates} == {9}
    assert found.best is None


def test_few_prompts_on_a_restless_bus_are_told_to_prove_little():
    chance, words = random.Random(3), {}

    def restless(_, count):
        # Another word every 3 s, about as often as a person acts.
        return words.setdefault(count // 30, bytes(chance.randrange(256) for _ in range(8)))
    found = learned(Sender(0x500, restless), demo_sender(), prompts=4)
    assert found.by_chance > 0.1
    assert any("more prompts make it surer" in doubt for doubt in doubts(found))


@pytest.mark.parametrize("prompts", [0, 2, 5, 42])
def test_unsuitable_numbers_of_prompts_are_refused(prompts):
    with pytest.raises(InvalidParameter, match="even numbers from 4 to 40"):
        LearnSession(prompts)


def test_profile_that_is_written_reads_the_bus_as_the_shipped_one(tmp_path):
    write_profile(tmp_path / "my_car.yaml", learned(*background(), demo_sender()))
    mine, shipped = load_profile(str(tmp_path / "my_car.yaml")), load_profile("mtr_demo_car")
    assert (mine.cycle_time_s, mine.sent_on_change) == (shipped.cycle_time_s, shipped.sent_on_change)
    message = DemoLockMessage()
    for is_locked in (True, False, False, True):
        message.is_locked = is_locked
        data = message.next()
        mine_says, shipped_says = mine.decode(0x320, False, data), shipped.decode(0x320, False, data)
        assert (mine_says.state, mine_says.alive, mine_says.commands) == \
            (shipped_says.state, shipped_says.alive, shipped_says.commands)


def test_profile_of_an_extended_message_is_read_back(tmp_path):
    found = learned(Sender(0x18DA10F1, lambda is_locked, _: bytes([0, 4 * is_locked]), is_extended=True))
    write_profile(tmp_path / "van.yaml", found)
    profile = load_profile(str(tmp_path / "van.yaml"))
    assert profile.decode(0x18DA10F1, True, b"\0\4").state is LockState.LOCKED
    assert profile.decode(0x18DA10F1, True, b"\0\0").state is LockState.UNLOCKED


def test_profile_that_is_there_is_not_overwritten(tmp_path):
    found = learned(demo_sender())
    (tmp_path / "my_car.dbc").write_text("mine", encoding="utf-8")
    with pytest.raises(OutputError, match="is there already"):
        write_profile(tmp_path / "my_car.yaml", found)
    assert not (tmp_path / "my_car.yaml").exists()


@pytest.mark.parametrize("name", ["my car.yaml", "my_car.txt", ".yaml"])
def test_unsuitable_names_are_refused(tmp_path, name):
    with pytest.raises(InvalidParameter, match=r"\.yaml at the end"):
        write_profile(tmp_path / name, learned(demo_sender()))


def test_table_names_byte_and_bits():
    found = learned(demo_sender())
    assert cells(found.best, found.stays) == ("320", "0.0", "0", "1", "10/10", "0 ms", "20 ms",
                                              "counter 2.0-3, counts changes 1.0-7")
    assert place(Field(11, 2)) == "1.3-4"
