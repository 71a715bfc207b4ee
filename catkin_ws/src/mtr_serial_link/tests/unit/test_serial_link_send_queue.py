"""Frames that wait for the port: limited in bytes and age, and discarded after a gap."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_serial_link.send_queue import DEAF_S, GAP_S, MAX_AGE_S, MAX_BYTES, SendQueue

FRAME = b"0123456789"


def port(queue, now_s, room):
    """Return the bytes that a port with this capacity receives."""
    got = b""
    while room > len(got):
        data = queue.next(now_s)[:room - len(got)]
        if not data:
            break
        queue.taken(len(data))
        got += data
    return got


def test_frames_leave_in_order_though_the_port_takes_them_in_pieces():
    queue = SendQueue()
    queue.put([b"abc", b"def"], 0.0)
    assert [port(queue, 0.0, 2) for _ in range(4)] == [b"ab", b"cd", b"ef", b""]
    assert not queue and not queue.dropped


def test_port_that_takes_nothing_for_forty_seconds_gets_no_old_frame():  # F2
    """Without the age limit, all of these orders arrive, up to 40 s old."""
    queue = SendQueue()
    for turn in range(1, 2000):
        queue.is_deaf(0.02 * turn)
        queue.put([b"%04d" % turn], 0.02 * turn)
    got = port(queue, 40.0, 10 ** 6)
    assert got[:4] == b"1975" and len(got) == 4 * 25 and queue.dropped == 1974


def test_bytes_that_wait_are_bounded_and_the_newest_stay():  # F2
    queue = SendQueue()
    queue.put([b"%010d" % number for number in range(10_000)], 0.0)
    got = port(queue, 0.0, 10 ** 6)
    assert len(got) == MAX_BYTES and got.endswith(b"0000009999")


def test_frame_that_has_begun_goes_on_so_that_the_next_one_is_understood():
    queue = SendQueue()
    queue.put([FRAME, FRAME], 0.0)
    assert port(queue, 0.0, 4) == b"0123"
    assert port(queue, 10.0, 100) == b"456789" and queue.dropped == 1


@pytest.mark.parametrize("gap_s, is_dropped", [(GAP_S, False), (GAP_S + 0.01, True)])
def test_all_is_given_up_after_a_gap_and_what_still_arrives_shortly_after_it(gap_s, is_dropped):  # F2, B8
    queue = SendQueue()
    assert not queue.is_deaf(100.0), "the first turn follows none"
    queue.put([FRAME], 100.0 + gap_s)
    assert queue.is_deaf(100.0 + gap_s) is is_dropped
    assert bool(queue) is not is_dropped
    assert queue.is_deaf(100.0 + gap_s + 0.9 * DEAF_S) is is_dropped
    assert not queue.is_deaf(100.0 + gap_s + DEAF_S)


def test_new_port_gets_nothing_of_before():
    queue = SendQueue()
    queue.put([FRAME], 0.0)
    assert port(queue, 0.0, 4)
    queue.clear()
    assert not queue.next(0.0) and not queue and not queue.is_deaf(100.0 + MAX_AGE_S)
