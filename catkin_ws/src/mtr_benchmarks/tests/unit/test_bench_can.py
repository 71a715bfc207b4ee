"""The benchmark of the Car's bus: what is lost is counted, what could not be filled is not met."""
# SPDX-License-Identifier: Apache-2.0
import json

import pytest

from mtr_benchmarks.can_bus.__main__ import report
from mtr_benchmarks.can_bus.learning import is_found
from mtr_benchmarks.can_bus.listening import Listened, on_terminal, on_virtual_bus
from mtr_benchmarks.can_bus.replaying import Replayed, replayed_autolock
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


def test_replay_agrees_with_the_test(tmp_path):
    found = replayed_autolock(tmp_path)
    assert found.worst_m <= 1e-4 and found.distances >= 10


def test_table_is_met_by_a_good_link_alone(tmp_path):
    good, replayed = report([GOOD], [True] * 96 + [False] * 4, Replayed(1e-6, 16)), Replayed(1e-6, 16)
    assert finish(good, tmp_path / "can.json") == 0
    names = [row["name"] for row in json.loads((tmp_path / "can.json").read_text())["table"]]
    assert names[0] == "frames lost: a bus" and len(names) == 6
    for bad in (report([Listened("a bus", 1000, 1000, 999, 1.0, 0.3, [0.001])], [True], replayed),
                report([Listened("a bus", 1000, 1000, 1000, 0.9, 0.3, [0.001])], [True], replayed),
                report([Listened("a bus", 1000, 1000, 1000, 1.0, 0.3, [0.02] * 9)], [True], replayed),
                report([GOOD], [True] * 94 + [False] * 6, replayed), report([GOOD], [True], Replayed(2e-4, 16)),
                report([GOOD], [True], Replayed(0.0, 2)), report([GOOD], [], replayed)):
        assert not all_met(bad.rows)


def test_signal_that_is_hidden_among_few_messages_is_found(monkeypatch):
    monkeypatch.setattr("mtr_benchmarks.can_bus.learning._FRAMES_PER_S", 300.0)
    assert [is_found(seed, prompts=10) for seed in range(3)].count(True) == 3
