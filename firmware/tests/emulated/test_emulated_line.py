"""The flashed firmware on an emulated board, in lock-step: what it says on its line, when, and what it skips there."""
# SPDX-License-Identifier: Apache-2.0
import math
import statistics

import pytest
from serial_host import COMMAND, PRESS, STATE, SUBSCRIBER, Host, command, frame, press

from mtr_emulator import Emulator


def test_host_is_told_all_topics(host):
    names = {topic: (found.kind, found.name, found.type) for topic, found in host.topics.items()}
    assert names[COMMAND] == (SUBSCRIBER, "/firmware/command", "mtr_msgs/FirmwareCommand")
    assert names[STATE] == (0, "/firmware/state", "mtr_msgs/FirmwareState")
    assert len(names) == 8


def test_host_that_comes_late_is_told_all_topics_soon(mcu):
    with Emulator(mcu, stepped=True) as board:
        board.step(3_333_000)
        host = Host(board)
        host.run(0.5)
        assert len(host.topics) == 8 and len(host.states) > 2
        host.close()


def test_md5_sums_are_those_of_the_built_messages(host):
    messages = pytest.importorskip("mtr_msgs.msg")
    for topic in host.topics.values():
        assert topic.md5 == getattr(messages, topic.type.split("/")[1])._md5sum


def test_reports_come_in_time(host):
    host.states.clear()
    host.healths.clear()
    host.echoes.clear()
    host.inputs.clear()
    host.run(2.0)
    times = [state.time_us for state in host.states]
    gaps = {round((later - earlier) / 1000) for earlier, later in zip(times, times[1:])}
    assert len(times) in (49, 50, 51) and gaps <= {39, 40, 41}
    assert len(host.healths) in (9, 10, 11)
    assert len(host.echoes) in (19, 20, 21)
    assert len(host.inputs) in (24, 25, 26)


def test_half_of_the_echoes_come_within_six_milliseconds(host):
    host.is_talking = False
    waits_ms = []
    for seq in range(40):
        host.run(0.053, step_us=1000)
        host.echoes.clear()
        host.send(command(seq, math.nan, host.latest_us))
        waits_ms.append(0.0)
        while not host.echoes and waits_ms[-1] < 50.0:
            host.run(0.0005, step_us=500)
            waits_ms[-1] += 0.5
        assert host.echoes == [seq]
    # The others wait behind a state report (8.9 ms on the line), the worst behind a health report too.
    assert statistics.median(waits_ms) <= 6.0 and max(waits_ms) <= 25.0


def test_unknown_topics_and_oversized_frames_are_skipped(host):
    host.send(frame(999, b"abc") + frame(COMMAND, bytes(2000)) + frame(PRESS, b"\xff" * 24))
    host.run(0.6)
    assert host.healths[-1].skipped_frames >= 3
    assert host.state.fault == 0 and host.state.press_id == 0
    host.states.clear()
    host.run(0.5)
    assert len(host.states) > 10


def test_wrong_crc_inside_a_good_frame_is_not_obeyed(host):
    good = press(1, host.latest_us)
    host.send(frame(PRESS, good[7:-2] + bytes([good[-2] ^ 1])))
    host.run(0.5)
    assert host.state.press_id == 0 and host.healths[-1].checksum_errors == 1
