"""Soak: growth is detected and fluctuation is not; processes are read from /proc."""
# SPDX-License-Identifier: Apache-2.0
import math
import os
import random
import socket
import subprocess
import sys
from types import SimpleNamespace

import pytest

from mtr_benchmarks.soak import __main__ as soak_main
from mtr_benchmarks.soak.figures import PROCESSES, QUANTITIES, Place, by_halves, trends_of, unseen
from mtr_benchmarks.soak.processes import Usage, below, usage_of, waiting_bytes
from mtr_benchmarks.soak.samples_file import SamplesFile
from mtr_benchmarks.soak.trend import Trend, difference, growing, trend_of


def series(slope_per_hour, noise, seed=1, hours=1.0, wander=0.0):
    chance, walked = random.Random(seed), 0.0
    for second in range(0, int(3600 * hours), 10):
        walked = 0.9 * walked + chance.gauss(0.0, wander)
        yield second, 100.0 + slope_per_hour * second / 3600.0 + chance.gauss(0.0, noise) + walked


def test_growth_of_a_mebibyte_an_hour_is_found_below_noise():
    trend = trend_of(list(series(1.0, 0.5)))
    assert trend.per_hour == pytest.approx(1.0, abs=0.2) and not trend.is_flat and growing([trend]) == 1


def test_what_only_wavers_is_flat_in_nineteen_of_twenty():
    flat = sum(trend_of(list(series(0.0, 0.5, seed, wander=0.3))).is_flat for seed in range(200))
    assert 180 <= flat <= 199


def test_what_never_changes_is_flat_and_what_shrinks_does_not_grow():
    assert trend_of([(float(second), 7.0) for second in range(100)]) == Trend(0.0, 0.0, 1.0)
    assert growing([trend_of(list(series(-5.0, 0.5)))]) == 0


def test_two_samples_tell_nothing():
    with pytest.raises(ValueError):
        trend_of([(0.0, 1.0), (1.0, 2.0)])


def test_of_many_processes_one_that_grows_is_counted_and_chance_is_not():
    quiet = [trend_of(list(series(0.0, 0.5, seed))) for seed in range(20)]
    assert growing(quiet) == 0 and growing([*quiet, trend_of(list(series(2.0, 0.5, 99)))]) == 1


def test_growth_while_it_warms_up_does_not_count():
    usages = [(float(second), Usage(min(second, 600) / 10.0, 5, 1, 0)) for second in range(0, 3600, 10)]
    assert trends_of({"node": usages}, "memory, MiB")["node"].is_flat
    assert trends_of({"gone": usages[:2]}, "memory, MiB") == {}


def usages(name, hours=1.0):
    return [(float(second), Usage(40.0, 30, 20, 0)) for second in range(0, int(3600 * hours) + 1, 10)]


WHOLE = {name: usages(name) for name in PROCESSES}


@pytest.mark.parametrize("samples, missing", [
    (WHOLE, []), ({}, sorted(PROCESSES)),
    ({name: each for name, each in WHOLE.items() if name != "localization"}, ["localization"]),
    # The watcher ended early; a process was missing at the beginning, or for a while.
    ({name: each[:100] for name, each in WHOLE.items()}, sorted(PROCESSES)),
    ({**WHOLE, "dispatcher": usages("")[100:]}, ["dispatcher"]),
    ({**WHOLE, "dispatcher": [*usages("")[:100], *usages("")[200:]]}, ["dispatcher"]),
    # An unexpected process grew within two samples.
    ({**WHOLE, "other": [(10.0, Usage(40, 30, 20, 0)), (20.0, Usage(900, 3000, 200, 0))]}, ["other"])])
def test_process_that_was_not_seen_all_the_time_is_missing(samples, missing):
    assert unseen(samples, 3600.0) == missing


def test_soak_whose_watcher_saw_nothing_is_not_what_it_must_be():
    chance = random.Random(1)
    wanderer = SimpleNamespace(places=[Place(10.0 * each, chance.gauss(0.01, 0.001), each // 4) for each in range(400)],
                               faults={"imu off": 9}, failures=[])
    assert all(row.is_met for row in soak_main.report(WHOLE, wanderer, 1.0, True).rows)
    unmet = [row.requirement.name for row in soak_main.report({}, wanderer, 1.0, True).rows if not row.is_met]
    assert unmet[0] == soak_main.UNSEEN.name and len(unmet) == 1 + len(QUANTITIES)


def test_difference_has_an_interval():
    worse, half_width = difference([0.010, 0.012, 0.011, 0.009], [0.020, 0.022, 0.021, 0.019])
    assert worse == pytest.approx(0.010) and half_width < 0.003
    assert all(map(math.isnan, difference([0.01], [0.02])))


def test_errors_are_means_of_maps_in_their_order():
    places = [Place(0.0, 0.01, 1), Place(1.0, 0.03, 1), Place(2.0, 0.05, 2)]
    assert by_halves(places) == ([pytest.approx(0.02)], [0.05])


def test_use_of_a_process_is_read_and_its_node_has_a_name():
    here, there = socket.socketpair()
    command = [sys.executable, "-c", "print('ready', flush=True); input()", "__name:=localization"]
    with here, there, subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as child:
        # Before its first output, the child may still be a copy of this process.
        assert child.stdout.readline() == b"ready\n"
        assert below(os.getpid())[child.pid] == "localization"
        usage = usage_of(child.pid, {})
        assert usage.private_mib > 1.0 and usage.files >= 3 and usage.threads == 1
        own = usage_of(os.getpid(), {os.readlink(f"/proc/self/fd/{here.fileno()}")[len("socket:["):-1]: 77})
        assert own.queued_bytes == 77
        child.communicate(b"\n")
    assert usage_of(child.pid, {}) is None


def test_bytes_that_nobody_reads_are_counted():
    with socket.create_server(("127.0.0.1", 0)) as listener, \
            socket.create_connection(listener.getsockname()) as sender, listener.accept()[0] as receiver:
        sender.sendall(bytes(1000))
        assert usage_of(os.getpid(), waiting_bytes()).queued_bytes >= 1000
        assert len(receiver.recv(1000)) == 1000


def test_samples_are_in_the_file_while_it_is_open(tmp_path):
    with SamplesFile(tmp_path / "soak" / "samples.csv") as file:
        file.add(12.34, "dispatcher", Usage(45.6789, 30, 7, 0))
        assert (tmp_path / "soak" / "samples.csv").read_text(encoding="utf-8").splitlines() == [
            "time_s,process,private_mib,files,threads,queued_bytes", "12.3,dispatcher,45.679,30,7,0"]
