"""Counters that do not have a power of two of values: healthy frames are believed, and jumps are not."""
# SPDX-License-Identifier: Apache-2.0
import itertools

import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.frame_judge import FrameJudge
from mtr_operator.car_link.further.companions import Companions
from mtr_operator.car_link.further.counting import CountRange, CountWatch
from mtr_operator.car_link.further.spoken_frames import SpokenFrames
from mtr_operator.car_link.learn.database_names import DatabaseNames
from mtr_operator.car_link.learn.findings import findings_of
from mtr_operator.car_link.learn.session import LearnSession, Stage
from mtr_operator.car_link.learn.written_profile import write_profile
from mtr_operator.car_link.profile import load_profile
from mtr_operator.cli.cars.trying import try_profile
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import LockState

# Lowest and highest value, and bits.
COUNTERS = [(0, 15, 4), (0, 14, 4), (1, 15, 4), (1, 14, 4), (0, 9, 4), (0, 255, 8), (0, 254, 8), (1, 255, 8),
            (0, 253, 8), (0, 99, 7), (0, 7, 3), (0, 6, 3), (0, 3, 2), (0, 2, 2)]


def counting(low, high, count, first=0):
    return [low + (first + index) % (high - low + 1) for index in range(count)]


def doubts(values, counter, may_learn=True):
    """Places of the values that do not go on by one."""
    watch = CountWatch(counter, may_learn)
    return [index for index, (before, now) in enumerate(itertools.pairwise(values), 1) if watch.step(before, now) != 1]


@pytest.mark.parametrize(("low", "high", "length"), COUNTERS)
@pytest.mark.parametrize("first", [0, 1, 5, 13])
@pytest.mark.parametrize("kind", ["nothing", "database", "wrong database", "declared"])
def test_healthy_counter_is_never_refused(low, high, length, first, kind):
    counter = {"nothing": CountRange(0, (1 << length) - 1, length), "database": CountRange(low, high, length),
               "wrong database": CountRange(0, 2, length), "declared": CountRange(low, high, length, True)}[kind]
    assert doubts(counting(low, high, 1000, first), counter) == []


@pytest.mark.parametrize(("low", "high", "length"), COUNTERS)
def test_lost_frame_is_a_doubt_once_the_counter_is_known(low, high, length):
    values = counting(low, high, 4 * (high - low + 1))
    for at in range(3 * (high - low + 1), len(values) - 1):
        assert doubts(values[:at] + values[at + 1:], CountRange(0, (1 << length) - 1, length)) != []


def test_end_that_was_only_a_lost_frame_is_a_doubt_when_it_is_counted_beyond():
    assert doubts([3, 4, 5, 0, 1, 2, 3, 4, 5, 6], CountRange(0, 15, 4)) == [9]
    assert doubts([3, 4, 5, 0, 1], CountRange(0, 15, 4), may_learn=False) == [3]


@pytest.mark.parametrize("odd", [[15], [7], [], [15, 15, 9]])
@pytest.mark.parametrize("at", [0, 3, 14, 15, 45, 50])
@pytest.mark.parametrize("may_learn", [True, False])
@pytest.mark.parametrize(("low", "high"), [(0, 14), (0, 15), (1, 14)])
def test_unusual_value_is_doubted_only_where_it_is(odd, at, may_learn, low, high):
    values = counting(low, high, at) + odd + counting(low, high, 300)
    found = doubts(values, CountRange(0, 15, 4), may_learn)
    # Every unusual value, and at most one later wrap that was not known yet.
    assert len(found) <= len(odd) + 2 and all(index <= at + len(odd) + 16 for index in found), found


@pytest.mark.parametrize(("low", "high", "length"), [(2, 15, 4), (3, 12, 4), (2, 5, 3), (5, 200, 8), (2, 255, 8)])
@pytest.mark.parametrize("may_learn", [True, False])
def test_wrap_to_any_value_is_a_doubt_once_and_then_known(low, high, length, may_learn):
    values = counting(low, high, 6 * (high - low + 1))
    assert doubts(values, CountRange(0, (1 << length) - 1, length), may_learn) == [high - low + 1]


def test_wrong_wrap_is_replaced_by_the_one_that_repeats():
    # 15 is lost twice in a row, which looks like a wrap of 0 to 14.
    values = counting(0, 14, 30) + counting(0, 15, 160)
    assert doubts(values, CountRange(0, 15, 4))[-1] <= 30 + 2 * 16


def test_declared_counter_has_no_other_value():
    declared = CountRange(0, 14, 4, True)
    assert doubts([13, 14, 15, 0, 1], declared) == [2, 3]
    assert doubts([13, 14, 0, 2], declared) == [3]


@pytest.mark.parametrize(("low", "high", "length"), [each for each in COUNTERS if each[1] >= (1 << each[2]) - 2])
def test_healthy_counter_of_commands_is_never_refused(low, high, length):
    assert doubts(counting(low, high, 600), CountRange(0, (1 << length) - 1, length), may_learn=False) == []


DATABASE = """VERSION ""
BU_: GW
BO_ 801 DOORS: 4 GW
 SG_ LOCK : 0|2@1+ (1,0) [0|3] "" GW
 SG_ ALIVE : 8|4@1+ (1,0) [{limits}] "" GW
 SG_ EVENTS : 16|4@1+ (1,0) [0|0] "" GW
BO_ 802 OTHER: 1 GW
 SG_ COUNT : 0|4@1+ (1,0) [0|15] "" GW
"""
PROFILE = """database: car.dbc
message: DOORS
signal: LOCK
states: {0: locked, 1: unlocked}
cycle_time_s: 0.1
alive_signal: ALIVE
command_signal: EVENTS
"""
SIGNED = DATABASE.replace("4@1+", "4@1-")
BIG_ENDIAN = DATABASE.replace("8|4@1+", "11|4@0-").replace("16|4@1+", "19|4@0-").replace("0|4@1+", "3|4@0-")
ELSEWHERE = PROFILE.replace("alive_signal: ALIVE", "alive_signal: {message: OTHER, signal: COUNT, values: [0, 14]}")


def written(folder, *lines, limits="0|0", profile=PROFILE, database=DATABASE):
    (folder / "car.dbc").write_text(database.format(limits=limits))
    path = folder / "car.yaml"
    path.write_text(profile + "".join(f"{line}\n" for line in lines))
    return str(path)


@pytest.mark.parametrize("lines", [(), ("alive_values: [0, 14]",), ("alive_values: 15",)])
@pytest.mark.parametrize("limits", ["0|0", "0|14", "0|15"])
def test_frames_of_a_car_with_e2e_counters_are_believed(tmp_path, lines, limits):
    profile = load_profile(written(tmp_path, *lines, limits=limits))
    judge = FrameJudge(profile)
    for index in range(3000):
        changes = index // 20
        data = bytes([changes % 2, index % 15, changes % 15, 0])
        assert judge.judge(profile.decode(801, False, data), 0.1 * index) == "", index


def test_jump_and_invalid_value_are_doubted(tmp_path):
    profile = load_profile(written(tmp_path, "alive_values: [0, 14]"))
    judge = FrameJudge(profile)
    said = [judge.judge(profile.decode(801, False, bytes([0, count, 0, 0])), 0.1 * index)
            for index, count in enumerate([12, 13, 14, 0, 15, 1])]
    assert said[:4] == ["", "", "", ""] and "went from 0 to 15" in said[4] and "went from 15 to 1" in said[5]


def test_counter_of_another_message_has_values_of_its_own(tmp_path):
    entry = "alive_signal: {message: OTHER, signal: COUNT, values: [0, 14]}"
    profile = load_profile(written(tmp_path, profile=PROFILE.replace("alive_signal: ALIVE", entry)))
    companions = Companions(profile.further)
    assert not any(companions.frame(("", 802, False), bytes([index % 15]), 0.1 * index) for index in range(300))
    assert companions.frame(("", 802, False), bytes([9]), 40.0) != []


@pytest.mark.parametrize("line", ["alive_values: [0, 14]", "alive_values: [1, 15]", "command_values: [0, 14]"])
def test_simulated_car_counts_as_the_profile_says(tmp_path, line):
    profile = load_profile(written(tmp_path, line))
    frames, judge = SpokenFrames(profile), FrameJudge(profile)
    for index in range(400):
        frames.is_locked = index // 10 % 2 == 0
        (_, message), = frames.next()
        assert judge.judge(profile.decode(801, False, bytes(message.data)), 0.1 * index) == ""


@pytest.mark.parametrize("limits", ["0|7", "-8|7", "0|0", "0|14"])
@pytest.mark.parametrize("lines", [(), ("alive_values: [0, 14]", "command_values: 15"), ("alive_values: 15",)])
@pytest.mark.parametrize("database", [SIGNED, BIG_ENDIAN], ids=["little endian", "big endian"])
def test_signed_counters_are_compared_without_their_sign(tmp_path, limits, lines, database):
    profile = load_profile(written(tmp_path, *lines, limits=limits, database=database))
    judge = FrameJudge(profile)
    for index in range(600):
        changes = index // 20
        data = bytes([changes % 2, index % 15, changes % 15, 0])
        assert judge.judge(profile.decode(801, False, data), 0.1 * index) == "", index
    assert "ALIVE of the Car's lock message went from 14 to 9" in judge.judge(
        profile.decode(801, False, bytes([1, 9, 14, 0])), 60.0)


@pytest.mark.parametrize(("profile", "lines"), [(PROFILE, ("alive_values: 15",)), (PROFILE, ("alive_values: [1, 15]",)),
                                                (PROFILE, ("command_values: [1, 15]",)), (ELSEWHERE, ())])
def test_simulated_car_and_link_agree_on_signed_counters(tmp_path, profile, lines):
    assert try_profile(written(tmp_path, *lines, profile=profile, database=SIGNED)).is_good


def test_signed_counter_of_another_message_has_its_values(tmp_path):
    companions = Companions(load_profile(written(tmp_path, profile=ELSEWHERE, database=SIGNED)).further)
    assert not any(companions.frame(("", 802, False), bytes([index % 15]), 0.1 * index) for index in range(300))
    doubt, = companions.frame(("", 802, False), bytes([9]), 40.0)
    assert "went from 14 to 9" in doubt


@pytest.mark.parametrize(("line", "words"), [
    ("alive_values: [0, 16]", r"alive_values is \[0, 16\]; allowed are the lowest and the highest value"),
    ("alive_values: [3, 3]", "allowed are the lowest"), ("alive_values: yes", "allowed are the lowest"),
    ("alive_values: 17", "allowed are the lowest"), ("command_values: [a, b]", "command_values is")])
def test_values_that_a_counter_cannot_have_are_refused(tmp_path, line, words):
    with pytest.raises(ConnectionFailed, match=words):
        load_profile(written(tmp_path, line))


def test_values_without_their_counter_are_refused(tmp_path):
    with pytest.raises(ConnectionFailed, match="alive_values belongs to alive_signal, which is missing"):
        load_profile(written(tmp_path, "alive_values: 15", profile=PROFILE.replace("alive_signal: ALIVE\n", "")))


def recorded(data):
    """Findings of a bus with one message each 20 ms. data(is_locked, count, changes): of a frame."""
    session = LearnSession(10)
    session.begin(0.0)
    changes, before = 0, False
    for step in itertools.count():
        stage = session.tick(0.02 * step)
        if stage is Stage.COMPLETE:
            return findings_of(session.recording)
        if stage is Stage.ASKED:
            session.done(0.02 * step)
        is_locked = stage is not Stage.REST and session.wanted is LockState.LOCKED
        changes, before = changes + (is_locked is not before), is_locked
        session.recording.frame(CanFrame(801, False, data(is_locked, step, changes), 0.02 * step + 0.01))


@pytest.mark.parametrize("counter", [each for each in COUNTERS if each[1] < 200])
@pytest.mark.parametrize("lost", [0, 40])
@pytest.mark.parametrize("beside", [0x00, 0x80])
def test_learned_counter_has_the_values_that_were_seen(tmp_path, counter, lost, beside):
    low, high, length = counter

    def data(is_locked, count, _changes):
        missed = count + count // lost if lost else count
        return bytes([int(is_locked), beside | counting(low, high, 1, missed)[0], 0, 0])
    found = recorded(data)
    is_full = (low, high) == (0, (1 << length) - 1)
    assert found.best.counter == (8, length)
    assert found.best.counter_values == (None if is_full else (low, high))
    write_profile(tmp_path / "learned.yaml", found)
    profile = load_profile(str(tmp_path / "learned.yaml"))
    judge = FrameJudge(profile)
    for index in range(600):
        assert judge.judge(profile.decode(801, False, bytes([1, beside | counting(low, high, 1, index)[0], 0, 0])),
                           0.1 * index) == ""


@pytest.mark.parametrize(("count_at", "values", "odd"), [
    (lambda index: 2 + index % 14, (2, 15), 0), (lambda index: 3 + index % 10, (3, 12), 0),
    (lambda index: 15 if index == 45 else (index - (index > 45)) % 15, (0, 14), 2),
    (lambda index: (index - 52 * (index >= 52)) % 15, (0, 14), 1),
    (lambda index: (index - 1) % 15 if index else 15, (0, 14), 1),
    (lambda index: (index - 53 * (index >= 53)) % 16, None, 1), (lambda index: 8 + index % 8, None, 0)])
def test_learned_counter_fits_its_own_recording(tmp_path, count_at, values, odd):
    def data(is_locked, count, _changes):
        return bytes([int(is_locked), count_at(count), 0, 0])
    found = recorded(data)
    assert found.best.counter_values == values
    write_profile(tmp_path / "learned.yaml", found)
    profile = load_profile(str(tmp_path / "learned.yaml"))
    judge = FrameJudge(profile)
    said = [judge.judge(profile.decode(801, False, data(True, index, 0)), 0.1 * index) for index in range(600)]
    assert sum(map(bool, said)) <= odd, list(filter(None, said))
    assert try_profile(str(tmp_path / "learned.yaml")).is_good


@pytest.mark.parametrize("has_names", [False, True])
@pytest.mark.parametrize("database", [DATABASE, SIGNED], ids=["unsigned", "signed"])
def test_learned_counters_of_a_database_are_believed_beyond_what_was_seen(tmp_path, has_names, database):
    def data(is_locked, count, changes):
        return bytes([1 - is_locked, count % 15, changes % 15, 0])
    written(tmp_path, database=database)
    names = DatabaseNames(tmp_path / "car.dbc") if has_names else None
    path = tmp_path / "learned.yaml"
    write_profile(path, recorded(data), names)
    text = path.read_text()
    assert "alive_values: [0, 14]" in text and "command_signal" in text and ("EVENTS" in text) is has_names
    profile = load_profile(str(path))
    judge = FrameJudge(profile)
    for index in range(1500):
        changes = index // 20
        reading = profile.decode(801, False, data(changes % 2 == 0, index, changes))
        assert judge.judge(reading, 0.1 * index) == "", index
