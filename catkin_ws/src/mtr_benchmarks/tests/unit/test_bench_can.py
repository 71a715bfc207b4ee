"""Benchmark of the Car's bus: lost frames are counted, and a bus that could not be filled does not meet the
requirement."""
# SPDX-License-Identifier: Apache-2.0
import json
import random
from types import SimpleNamespace

import pytest

from mtr_benchmarks.can_bus.__main__ import report
from mtr_benchmarks.can_bus.learning import is_found
from mtr_benchmarks.can_bus.listening import Listened, on_terminal, on_virtual_bus
from mtr_benchmarks.can_bus.load import run
from mtr_benchmarks.can_bus.replaying import Replayed, replayed_autolock
from mtr_benchmarks.can_bus.traffic import recorded_traffic
from mtr_benchmarks.harness.report import finish
from mtr_benchmarks.harness.rows import all_met

GOOD = Listened("a bus", 1000, 1000, 1000, 1.0, 0.3, [0.001] * 100)


@pytest.mark.parametrize("is_fd", [False, True])
def test_every_frame_of_the_virtual_bus_is_heard_and_in_the_log(tmp_path, is_fd):
    found = on_virtual_bus(tmp_path, 0.5, is_fd)
    assert found.sent_frames > 100 and found.lost == 0
    assert len(found.latencies_s) >= 1 and min(found.latencies_s) > 0.0


def test_every_frame_of_the_terminal_is_heard_and_in_the_log(tmp_path):
    found = on_terminal(tmp_path, 0.5)
    assert found.sent_frames > 100 and found.lost == 0 and found.latencies_s


def test_sender_that_was_held_up_sends_all_frames(monkeypatch):
    clock = iter([0.0, *[5.0] * 1000])
    monkeypatch.setattr("mtr_benchmarks.can_bus.load.time", SimpleNamespace(
        monotonic=lambda: next(clock), thread_time=lambda: 0.0, sleep=lambda _: None))
    sent = run(lambda *_: None, False, 0.1)
    assert sent.frames > 100 and sent.load < 1.0


def test_replay_agrees_with_the_test(tmp_path):
    found = replayed_autolock(tmp_path)
    assert found.worst_m <= 1e-4 and found.distances >= 10


def test_table_is_met_by_a_good_link_alone(tmp_path):
    good, replayed = report([GOOD], [True] * 96 + [False] * 4, Replayed(1e-6, 16)), Replayed(1e-6, 16)
    assert finish(good, tmp_path / "can.json") == 0
    names = [row["name"] for row in json.loads((tmp_path / "can.json").read_text())["table"]]
    assert names[0] == "frames lost: a bus" and len(names) == 6
    in_cars = report([GOOD], [True], replayed, [True] * 95 + [False] * 5)
    assert all_met(in_cars.rows) and len(in_cars.rows) == 7 and in_cars.figures["missed_seeds_recorded"][0] == 95
    for bad in (report([Listened("a bus", 1000, 1000, 999, 1.0, 0.3, [0.001])], [True], replayed),
                report([Listened("a bus", 1000, 1000, 1000, 0.9, 0.3, [0.001])], [True], replayed),
                report([Listened("a bus", 1000, 1000, 1000, 1.0, 0.3, [0.02] * 9)], [True], replayed),
                report([GOOD], [True] * 94 + [False] * 6, replayed), report([GOOD], [True], Replayed(2e-4, 16)),
                report([GOOD], [True], Replayed(0.0, 2)), report([GOOD], [], replayed),
                report([GOOD], [True], replayed, [True] * 9 + [False])):
        assert not all_met(bad.rows)


def test_signal_that_is_hidden_among_few_messages_is_found(monkeypatch):
    monkeypatch.setattr("mtr_benchmarks.can_bus.learning._FRAMES_PER_S", 300.0)
    assert [is_found(seed, prompts=10) for seed in range(3)].count(True) == 3


@pytest.fixture(name="log")
def log_fixture(tmp_path):
    """Return a log of two seconds with four messages of a car: a counter, a constant, an extended one, and one with a
    checksum."""
    lines = []
    for number in range(200):
        stamp = f"({1000.0 + 0.01 * number:.6f}) can0"
        lines += [f"{stamp} 123#{number % 256:02X}{number % 16:02X}", f"{stamp} 1A0#00FF00", f"{stamp} 12345678#0102"]
        lines += [f"{stamp} 2B0#{number // 7:02X}00{number // 7 ^ 0x5A:02X}"]
    path = tmp_path / "car.log"
    path.write_text("\n".join(lines) + "\n")
    return path


def test_recorded_traffic_is_repeated_until_the_bus_is_full(log):
    messages = list(recorded_traffic(log, random.Random(1), 1000.0))
    assert sum(1.0 / each.cycle_s for each in messages) == pytest.approx(1000.0, rel=0.15)
    assert len({(each.can_id, each.is_extended) for each in messages}) == len(messages) > 8
    first = next(each for each in messages if each.can_id == 0x123)
    times_s, counts = [], []
    for _ in range(450):
        times_s.append(first.due_s)
        counts.append(first.frame(first.due_s).data[0])
    assert times_s == sorted(times_s) and times_s[-1] == pytest.approx(4.5, abs=0.1)
    assert counts[:200] == list(range(200)) and counts[200] == 0


def test_signal_that_is_hidden_in_recorded_traffic_is_found(log, monkeypatch):
    monkeypatch.setattr("mtr_benchmarks.can_bus.learning._FRAMES_PER_S", 1000.0)
    assert [is_found(seed, log=log) for seed in range(3)].count(True) == 3
