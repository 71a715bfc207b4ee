"""Frames that are shorter than the database says: live link, log, learning and trial agree on what is in them."""
# SPDX-License-Identifier: Apache-2.0
import itertools

import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.further.spoken_frames import SpokenFrames
from mtr_operator.car_link.learn.database_names import DatabaseNames
from mtr_operator.car_link.learn.findings import findings_of
from mtr_operator.car_link.learn.session import LearnSession, Stage
from mtr_operator.car_link.learn.written_profile import write_profile
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.log.log_car import LogCarLink
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus

LOCK_ID = 0x321
# Where the state is in a message of eight bytes, and how many bytes a frame needs for it.
PLACES = {"0|2@1+": 1, "6|3@1+": 2, "15|2@0+": 2, "8|1@0+": 2, "23|2@0+": 3, "14|4@1+": 3, "62|2@1+": 8}
STATES = [LockState.LOCKED] * 30 + [LockState.UNLOCKED] * 30 + [LockState.LOCKED] * 30


def written(folder, place):
    """Path of a profile with the state at that place."""
    (folder / "car.dbc").write_text('VERSION ""\nBU_: Body\n'
                                    f"BO_ {LOCK_ID} DOORS: 8 Body\n SG_ LOCK : {place} (1,0) [0|0] \"\" Body\n")
    path = folder / "car.yaml"
    path.write_text("database: car.dbc\nmessage: DOORS\nsignal: LOCK\nstates: {0: locked, 1: unlocked}\n"
                    "cycle_time_s: 0.1\n")
    return path


def cut(profile, length):
    """Data of frames of a Car that `try` simulates, in both states, cut to a length."""
    frames, found = SpokenFrames(profile), {}
    for state in (LockState.LOCKED, LockState.UNLOCKED):
        frames.is_locked = state is LockState.LOCKED
        (_, message), = frames.next()
        found[state] = bytes(message.data)[:length]
    return found


def statuses():
    return [RobotStatus(index, 1, 50.0 + 0.1 * index, sent_s=50.0 + 0.1 * index, steady_s=50.0 + 0.1 * index)
            for index in range(len(STATES) + 5)]


def heard_live(profile, data):
    watch, events = LockWatch(profile), []
    for status, state in zip(statuses(), STATES):
        watch.frame(CanFrame(LOCK_ID, False, data[state], status.stamp_s - 0.05))
        watch.frame(CanFrame(0x100, False, b"", status.stamp_s - 0.04))
        watch.status(status, status.stamp_s)
        events += watch.release(status.stamp_s)
    return [event.lock_state for event in events], watch.problem


def heard_from_log(path, profile_path, data):
    lines = (f"({0.1 * index:.6f}) can0 {LOCK_ID:X}#{data[state].hex()}\n({0.1 * index + 0.01:.6f}) can0 100#\n"
             for index, state in enumerate(STATES))
    path.write_text("".join(lines))
    car, events, problem = LogCarLink(path, str(profile_path)), [], ""
    car.connect()
    for status in statuses()[:-8]:
        events += car.observe(status)
        problem = car.problem
    car.close()
    return [event.lock_state for event in events], problem


def learned(data):
    """Findings of a bus with these frames, whose Car does as it is asked."""
    session = LearnSession(4)
    session.begin(0.0)
    for step in itertools.count():
        stage = session.tick(0.1 * step)
        if stage is Stage.COMPLETE:
            return findings_of(session.recording)
        if stage is Stage.ASKED:
            session.done(0.1 * step)
        state = LockState.LOCKED if stage is Stage.REST else session.wanted
        session.recording.frame(CanFrame(LOCK_ID, False, data[state], 0.1 * step + 0.05))


@pytest.mark.parametrize(("place", "needed"), PLACES.items())
@pytest.mark.parametrize("length", [0, 1, 2, 3, 7, 8])
def test_all_agree_on_what_is_in_a_short_frame(tmp_path, place, needed, length):
    path = written(tmp_path, place)
    profile = load_profile(str(path))
    data, is_there = cut(profile, length), length >= needed
    readings = {state: profile.decode(LOCK_ID, False, each) for state, each in data.items()}
    assert [reading is not None and reading.state is state for state, reading in readings.items()] == 2 * [is_there]
    for events, problem in (heard_live(profile, data), heard_from_log(tmp_path / "bus.log", path, data)):
        assert events == ([LockState.UNLOCKED, LockState.LOCKED] if is_there else [])
        assert ("comes without the signal LOCK" in problem) is not is_there
    found, names = learned(data), DatabaseNames(tmp_path / "car.dbc")
    named = None if found.best is None else names.named(found.best)
    assert (named is not None and named.signal == "LOCK") is is_there
    if found.best is not None:
        # Whatever is learned is understood, with the names of the database or without.
        out = tmp_path / "learned.yaml"
        write_profile(out, found, names)
        assert all(load_profile(str(out)).decode(LOCK_ID, False, each).state is state for state, each in data.items())


def test_frames_of_two_lengths_are_read_each_as_it_is(tmp_path):
    path = written(tmp_path, "14|4@1+")
    profile = load_profile(str(path))
    long, short = cut(profile, 8), cut(profile, 2)
    assert profile.decode(LOCK_ID, False, long[LockState.UNLOCKED]).state is LockState.UNLOCKED
    assert profile.decode(LOCK_ID, False, short[LockState.UNLOCKED]) is None
