"""Feeds of a phone's distance: lines, TCP, serial, a signal of the Car's bus, and the simulated phone."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import pty
import socket
import threading

import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.phone import line_feed
from mtr_operator.car_link.phone.address import FeedAddress, feed_address, feed_at
from mtr_operator.car_link.phone.car_signal import CarSignalFeed
from mtr_operator.car_link.phone.lines import MAX_LINE_BYTES, MAX_LINES_PER_S, LineReader, Told
from mtr_operator.car_link.phone.simulated import PhoneModel, SimulatedPhone
from mtr_operator.car_link.profile import load_profile
from mtr_operator.cli.arguments import argument_parser
from mtr_operator.cli.links import lives_in_real_time
from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter
from mtr_operator.domain.robot_status import CarDimensions, RobotStatus

LIMIT_S = 10.0
CAR = CarDimensions(4.5, 1.8, 0.01, 0.01)
DATABASE = """VERSION ""
BU_: X
BO_ 291 LOCKS: 1 X
 SG_ STATE : 0|2@1+ (1,0) [0|3] "" X
BO_ 292 RANGING: 3 X
 SG_ UWB : 0|16@1+ (0.5,-20) [0|32000] "cm" X
 SG_ KIND : 16|2@1+ (1,0) [0|3] "apples" X
 SG_ FLAT : 18|2@1+ (0,0) [0|3] "cm" X
"""
PROFILE = """database: car.dbc
message: LOCKS
signal: STATE
states: {0: locked, 1: unlocked}
cycle_time_s: 0.1
"""


def status(stamp_s=5.0, x=5.25, y=0.0, car=CAR):
    return RobotStatus(id=1, robot_session_id=1, stamp_s=stamp_s, x=x, y=y, heading=0.0, pose_valid=True, car=car,
                       key_x=0.0)


def wait_for(condition):
    """Until something is so; the deadline is only for a failure."""
    done = threading.Event()
    for _ in range(int(LIMIT_S / 0.01)):
        if condition():
            return True
        done.wait(0.01)
    return False


@pytest.mark.parametrize(("line", "told"), [
    ("1.25", Told(1.25)), (" -0.5\r", Told(-0.5)), ('{"distance_m": 2}', Told(2.0)),
    ('{"distance_m": 2.5, "time_s": 7e5, "age_s": 0.1, "rssi": -60}', Told(2.5, 7e5, 0.1)),
    ('{"distance_m": "3.5", "time_s": null}', Told(3.5))])
def test_a_line_is_a_figure_or_an_object(line, told):
    reader = LineReader()
    assert reader.take(f"{line}\n".encode(), 0.0) == [told]
    assert reader.refused.count == 0


@pytest.mark.parametrize(("line", "sentence"), [
    ("1_5", "The line '1_5' is neither a number nor a JSON object with distance_m."),
    ('{"distance_m": "1_5"}', "The line '{\"distance_m\": \"1_5\"}' is neither a number nor a JSON object with "
     "distance_m."),
    ("\u0661.\u0665", "The line '\u0661.\u0665' is neither a number nor a JSON object with distance_m."),
    ("hello", "The line 'hello' is neither a number nor a JSON object with distance_m."),
    ("nan", "Reported distance is nan m; allowed is -10 to 500 m."),
    ("1e9", "Reported distance is 1e+09 m; allowed is -10 to 500 m."),
    ("{", "The line '{' is no JSON object."), ("{}", "The line '{}' has no distance_m."),
    ('{"distance_m": null}', "The line '{\"distance_m\": null}' says that no distance is known."),
    ('{"distance_m": [1]}', "The line '{\"distance_m\": [1]}' is neither a number nor a JSON object with distance_m."),
    ('{"distance_m": 1, "age_s": -1}', "Age_s is -1 s; allowed is 0 to 1e+06 s."),
    (MAX_LINE_BYTES * "1" + "1", f"A line is longer than {MAX_LINE_BYTES} bytes."),
    ('{"distance_m": ' + 300 * "[", "The line '" + ('{"distance_m": ' + 300 * "[")[:60] + "' is no JSON object.")])
def test_a_line_that_is_no_distance_is_refused_with_a_sentence(line, sentence):
    reader = LineReader()
    assert reader.take(f"{line}\n2.0\n".encode(), 0.0) == [Told(2.0)]
    assert (reader.refused.count, reader.refused.last) == (1, sentence)


def test_lines_come_in_pieces_and_one_without_an_end_fills_no_memory():
    reader = LineReader()
    assert reader.take(b"1.", 0.0) == []
    assert reader.take(b"5\n2", 0.0) == [Told(1.5)]
    for _ in range(100):
        assert reader.take(MAX_LINE_BYTES * b"9", 0.0) == []
    assert len(reader._rest) <= MAX_LINE_BYTES
    assert reader.take(b"9\n3.0\n", 0.0) == [Told(3.0)]
    assert reader.refused.count == 1


def test_more_lines_than_are_read_in_a_second_are_refused_until_it_is_over():
    reader = LineReader()
    assert len(reader.take((MAX_LINES_PER_S + 50) * b"1.0\n", 0.0)) == MAX_LINES_PER_S
    assert reader.refused.count == 50
    assert reader.take(b"1.0\n", 1.0) == [Told(1.0)]


def test_the_beginning_of_a_lost_connection_is_no_part_of_the_next():
    reader = LineReader()
    reader.take(b"1", 0.0)
    reader.restart()
    assert reader.take(b"2.0\n", 0.0) == [Told(2.0)]


@pytest.fixture
def server():
    with socket.create_server(("127.0.0.1", 0)) as listening:
        listening.settimeout(LIMIT_S)
        yield listening


def test_tcp_gives_what_is_sent_as_of_the_next_status_and_connects_anew(server, monkeypatch):
    monkeypatch.setattr(line_feed, "REOPEN_S", 0.01)
    port = server.getsockname()[1]
    feed = feed_at(feed_address(f"tcp:127.0.0.1:{port}"))
    assert feed.name == f"TCP 127.0.0.1:{port}"
    feed.connect()
    try:
        first, _ = server.accept()
        first.sendall(b'1.25\nrubbish\n{"distance_m": 1.5, "time_s": 3}\n')
        heard = []
        assert wait_for(lambda: heard.extend(feed.observe(status())) or len(heard) == 2)
        assert [(each.time_s, each.distance_m, each.feed_s) for each in heard] == [(5.0, 1.25, None), (5.0, 1.5, 3.0)]
        assert feed.refused.count == 1
        assert not feed.problem
        first.close()
        second, _ = server.accept()
        assert wait_for(lambda: not feed.problem)
        second.sendall(b"2.5\n")
        assert wait_for(lambda: [each.distance_m for each in feed.observe(status())] == [2.5])
        server.close()
        second.close()
        lost = f"The phone's distance does not come from {feed.name} any more: "
        assert wait_for(lambda: feed.problem.startswith(lost))
    finally:
        feed.close()
    assert feed.problem


def test_a_refused_connection_is_one_sentence(server):
    port = server.getsockname()[1]
    server.close()
    with pytest.raises(ConnectionFailed) as error:
        feed_at(FeedAddress("tcp", "127.0.0.1", port)).connect()
    assert str(error.value) == (f"The phone's distance cannot be read from TCP 127.0.0.1:{port}: connection refused; "
                                "start what sends it, or correct the feed's address.")


def test_silence_and_rubbish_from_the_start_are_told(server):
    now_s = [0.0]
    source = feed_at(feed_address(f"tcp:127.0.0.1:{server.getsockname()[1]}"))._source
    feed = line_feed.LineFeed(source, clock=lambda: now_s[0])
    feed.connect()
    try:
        assert not feed.problem
        now_s[0] = line_feed.SILENCE_S
        assert feed.problem == (f"Nothing has come from {feed.name} since it was connected; see whether it sends a "
                                "line for each distance.")
        connection, _ = server.accept()
        connection.sendall(b"GET / HTTP/1.1\n")
        assert wait_for(lambda: feed.refused.count == 1)
        assert feed.problem.startswith(f"What comes from {feed.name} is no distance: The line 'GET / HTTP/1.1' is ")
        connection.sendall(b"1.0\n")
        assert wait_for(lambda: not feed.problem)
        connection.close()
    finally:
        feed.close()


def test_a_serial_line_gives_what_is_sent():
    outside, inside = pty.openpty()
    feed = feed_at(feed_address(f"serial:{os.ttyname(inside)}:115200"))
    feed.connect()
    try:
        os.write(outside, b"0.75\n")
        assert wait_for(lambda: [each.distance_m for each in feed.observe(status())] == [0.75])
    finally:
        feed.close()
        os.close(outside)
        os.close(inside)


def test_a_serial_line_that_is_not_there_is_one_sentence(tmp_path):
    with pytest.raises(ConnectionFailed, match="cannot be read from serial line .*; start what sends it"):
        feed_at(FeedAddress("serial", str(tmp_path / "none"), 9600)).connect()


@pytest.mark.parametrize(("text", "part"), [
    ("tcp:host", "allowed is tcp:HOST:PORT"), ("udp:h:1", "allowed is tcp:HOST:PORT"), ("", "allowed is"),
    ("tcp:h:0", "port of the phone's feed is 0"), ("tcp:h:" + 5000 * "9", "allowed is 1 to 65535"),
    ("serial:/dev/x:1", "baud rate"), ("simulated:hue=1", "has no 'hue'"),
    ("simulated:bias_m=x", "allowed is a number"),
    ("simulated:dropouts=2", "dropouts is 2; allowed is 0 to 1"), ("simulated:scatter_m=nan", "scatter_m is nan")])
def test_an_address_that_is_none_is_refused(text, part):
    with pytest.raises(InvalidParameter, match=part):
        feed_address(text)


def test_an_address_may_have_colons_of_its_own():
    assert feed_address("tcp:[::1]:7070") == FeedAddress("tcp", "::1", 7070)


@pytest.fixture
def profile(tmp_path):
    def load(entry):
        (tmp_path / "car.dbc").write_text(DATABASE)
        path = tmp_path / "car.yaml"
        path.write_text(f"{PROFILE}phone_distance: {entry}\n")
        return load_profile(str(path)).phone
    return load


def ranging(raw):
    return CanFrame(292, False, raw.to_bytes(2, "little") + b"\0", 0.0)


def test_a_signal_of_the_cars_bus_is_read_in_its_unit(profile):
    feed = CarSignalFeed(profile("{message: RANGING, signal: UWB, no_distance: [65535]}"))
    for frame in (ranging(500), ranging(65535), CanFrame(291, False, b"\x01", 0.0), CanFrame(292, False, b"\x01", 0.0),
                  CanFrame(292, True, b"\0\0\0", 0.0), ranging(540)):
        feed.frame(frame)
    assert [(each.time_s, each.distance_m) for each in feed.observe(status())] == [
        (5.0, pytest.approx(2.30)), (5.0, pytest.approx(2.50))]
    assert feed.observe(status()) == []
    in_metres = CarSignalFeed(profile("{message: RANGING, signal: UWB, unit: m}"))
    in_metres.frame(ranging(2000))
    assert in_metres.observe(status()) == []
    assert in_metres.refused.last == "Reported distance is 980 m; allowed is -10 to 500 m."


@pytest.mark.parametrize(("entry", "part"), [
    ("7", "must be tcp:HOST:PORT"), ("{signal: UWB}", "must be tcp:HOST:PORT"),
    ("{message: NONE, signal: UWB}", "has no message NONE"), ("{message: RANGING, signal: NONE}", "has no signal NONE"),
    ("{message: RANGING, signal: KIND}", "has the unit apples"),
    ("{message: RANGING, signal: FLAT}", "signal FLAT, whose scale in the database is 0"),
    ("{message: RANGING, signal: UWB, bus: b}", "names the bus b"),
    ("{message: RANGING, signal: UWB, no_distance: 3}", "allowed is a list of whole numbers"),
    ("simulated", "is for the command line")])
def test_a_profile_that_declares_it_wrongly_is_refused(profile, entry, part):
    with pytest.raises(ConnectionFailed, match=part):
        profile(entry)


def test_a_profile_may_name_an_address(profile):
    assert profile("tcp:127.0.0.1:7070") == FeedAddress("tcp", "127.0.0.1", 7070)


def test_the_simulated_phone_has_the_errors_of_its_model_and_its_seed():
    model = PhoneModel(bias_m=0.3, body_m=0.0, scatter_m=0.1, dropouts=0.25, range_m=5.0, shadow_m=2.0)

    def told(seed, **place):
        phone = SimulatedPhone(seed, model)
        phone.connect()
        return [each.distance_m for step in range(2000) for each in phone.observe(status(0.1 * step, **place))]

    figures_m = told(1)
    assert figures_m == told(1) != told(2)
    assert len(figures_m) / 2000 == pytest.approx(0.75, abs=0.04)
    assert sum(figures_m) / len(figures_m) == pytest.approx(3.3, abs=0.01)
    assert told(1, x=7.5) == []              # beyond its range
    assert told(1, x=-4.75) == []            # in the shadow behind the Car
    assert told(1, x=-3.75) != []
    assert told(1, car=None) == []


@pytest.mark.parametrize(("extra", "lives"), [
    (["--simulated-car"], False), (["--simulated-car", "--phone-feed", "simulated:bias_m=0.2"], False),
    (["--simulated-car", "--phone-feed", "tcp:127.0.0.1:7070"], True), ([], True)])
def test_beside_a_feed_of_the_outside_the_robots_substitute_lives_in_real_time(extra, lives):
    options = argument_parser().parse_args(["run", "digital_key", "--params", "p", "--out", "o", *extra])
    assert lives_in_real_time(options) is lives
