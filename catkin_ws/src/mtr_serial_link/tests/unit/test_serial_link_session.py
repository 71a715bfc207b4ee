"""Serial session: negotiation, faults of the line, and the faults that stop rosserial's own host."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_serial_link.board_topics import board_topics
from mtr_serial_link.fake_device import FakeSerialDevice
from mtr_serial_link.frames import SerialFrame, encode
from mtr_serial_link.health import (
    MAX_REFUSAL_CHARACTERS,
    MAX_REFUSALS,
    OTHER_REFUSALS,
    REFUSAL_SHOWN_S,
    LineProblem,
)
from mtr_serial_link.parameters import SerialParameters
from mtr_serial_link.session import SerialSession
from mtr_serial_link.wire import LogLine, ReservedId, TopicInfo, encode_log

MD5 = {"mtr_msgs/State": "a" * 32, "mtr_msgs/Command": "b" * 32, "srv/CallRequest": "c" * 32}
STATE = (ReservedId.PUBLISHER, TopicInfo(125, "/state", "mtr_msgs/State", "a" * 32, 280))
COMMAND = (ReservedId.SUBSCRIBER, TopicInfo(101, "/command", "mtr_msgs/Command", "b" * 32, 20))
ROBOT_NS = 5_000_000_007
OURS = ("from /state mtr_msgs/State", "to /command mtr_msgs/Command")


class Cable:
    """A session and a device with a cable between them."""

    def __init__(self, *endpoints, expected=()):
        self.device = FakeSerialDevice(endpoints or (STATE, COMMAND))
        self.session = SerialSession(SerialParameters(), MD5.get, lambda: ROBOT_NS, board_topics(expected))
        self.now_s = 100.0
        self.events = []

    def plug(self):
        self.session.start(self.now_s)
        return self.run(0.0)

    def run(self, duration_s, said=b"", connected=True):
        """Advance the time in ticks of 0.1 s; the device sends `said` in each."""
        for _ in range(max(1, round(duration_s / 0.1))):
            self.events += self.session.tick(self.now_s)
            to_device, self.session.outbox[:] = b"".join(self.session.outbox), []
            answer = self.device.receive(to_device) + said if connected else b""
            if answer:
                self.events += self.session.receive(answer, self.now_s)
            self.now_s += 0.1
        return self

    @property
    def problem(self):
        return self.session.problem(self.now_s)

    def opened(self):
        return [event.opened.info.name for event in self.events if event.opened]


def line_message():
    return encode(SerialFrame(125, b"123"))


def test_device_is_asked_once_and_its_topics_are_opened():
    line = Cable().plug().run(1.0, line_message())
    assert line.opened() == ["/state", "/command"] and line.device.asked == 1 and line.problem is LineProblem.NONE


def test_messages_pass_both_ways_and_the_device_gets_the_robots_time():
    line = Cable().plug()
    assert line.session.send("/command", b"up")
    line.run(0.1, line_message())
    assert line.device.received == [SerialFrame(101, b"up")] and line.device.times[0] == ROBOT_NS
    assert [event.message for event in line.events if event.message] == [SerialFrame(125, b"123")]


def test_dead_device_is_noticed_within_a_second_and_asked_again():
    line = Cable().plug().run(2.0, line_message())
    line.run(1.1, connected=False)
    assert line.problem is LineProblem.LOST
    line.run(0.6)
    assert line.device.asked == 2 and line.problem is LineProblem.NONE


def test_device_that_started_again_and_forgot_the_host_is_back_at_the_next_question():
    line = Cable().plug().run(1.0, line_message())
    line.device = FakeSerialDevice((STATE, COMMAND))
    line.run(2.0)
    assert line.device.asked >= 1 and line.session.send("/command", b"up")
    assert line.opened() == ["/state", "/command"], "endpoints that did not change are not opened twice"


def test_silent_port_wrong_baud_and_old_protocol_are_told_apart():
    silent = Cable()
    silent.session.start(silent.now_s)
    silent.run(1.5, connected=False)
    assert silent.problem is LineProblem.SILENT
    for said, problem in ((bytes(range(1, 250)), LineProblem.WRONG_BAUD),
                          (b"\xff\xff\x00\x00\x00\x00\xff" * 40, LineProblem.REVISION)):
        line = Cable()
        line.device.receive = lambda data, said=said: said
        line.plug().run(1.5)
        assert line.problem is problem


def test_other_definition_of_a_message_is_refused_with_both_checksums_and_the_rest_works():
    other = (ReservedId.PUBLISHER, STATE[1]._replace(md5="f" * 32))
    line = Cable(other, COMMAND).plug()
    refusals = [event.refused for event in line.events if event.refused]
    assert len(refusals) == 1 and "f" * 32 in refusals[0] and "a" * 32 in refusals[0]
    assert line.opened() == ["/command"]


def test_unknown_message_type_is_refused_by_name():
    line = Cable((ReservedId.PUBLISHER, STATE[1]._replace(type_name="other_msgs/Thing"))).plug()
    assert "other_msgs/Thing" in next(event.refused for event in line.events if event.refused)


def test_message_longer_than_the_devices_buffer_is_counted_and_the_line_goes_on():
    line = Cable().plug()
    assert not line.session.send("/command", bytes(21)) and line.session.health.oversized == 1
    assert "21 bytes for /command" in next(iter(line.session.health.refusals))
    assert line.session.send("/command", bytes(20))
    line.run(0.1, line_message())
    assert line.device.received == [SerialFrame(101, bytes(20))] and line.problem is LineProblem.NONE


def test_message_on_an_unknown_topic_makes_the_host_ask_but_not_with_each_message():
    line = Cable().plug().run(1.0, line_message())
    line.run(1.0, 20 * encode(SerialFrame(140, b"?")))
    assert 2 <= line.device.asked <= 4 and line.session.health.unknown_topics == 200


def test_sentences_of_the_device_are_passed_on():
    line = Cable().plug().run(0.1, encode(SerialFrame(ReservedId.LOG, encode_log(LogLine(3, "The lift is jammed.")))))
    assert LogLine(3, "The lift is jammed.") in [event.log for event in line.events]


def test_description_that_makes_no_sense_is_counted_and_survived():
    line = Cable().plug().run(0.2, encode(SerialFrame(ReservedId.PUBLISHER, b"\x7d\x00\xff\xff\xff\xff")))
    assert any("could not be read" in sentence for sentence in line.session.health.refusals)
    assert line.problem is LineProblem.NONE


def test_host_says_goodbye():
    line = Cable().plug()
    line.session.stop()
    line.run(0.1)
    assert line.device.stopped


def damaged(line):
    """Corrupt the device's description of /command by one bit, once."""
    describe, left = line.device.receive, [1]

    def receive(data):
        answer = bytearray(describe(data))
        at = answer.find(b"/command")
        if at >= 0 and left:
            left.pop()
            answer[at + 1] ^= 1
        return bytes(answer)
    line.device.receive = receive
    return line


def test_topic_whose_description_was_damaged_is_asked_for_again_though_nothing_else_shows_it():  # N1
    """Without a repeated request, all commands are dropped."""
    line = damaged(Cable(expected=OURS)).plug().run(0.4, line_message())
    assert line.opened() == ["/state"] and line.problem is LineProblem.NONE
    line.run(0.4, line_message())
    assert line.opened() == ["/state", "/command"] and line.device.asked == 2
    assert line.run(10.0, line_message()).device.asked == 2 and not line.session.missing


def test_name_that_is_sent_to_and_not_known_is_asked_for_without_expectations_too():  # N1
    line = damaged(Cable()).plug().run(0.3, line_message())
    assert not line.session.send("/command", b"up")
    line.run(0.5, line_message())
    assert line.session.send("/command", b"up")


def test_topic_that_the_board_does_not_have_is_told_and_asked_for_ever_more_seldom():  # N1
    line = Cable(STATE, expected=OURS).plug().run(60.0, line_message())
    assert line.session.missing == ["/command"]
    assert 8 <= line.device.asked <= 12


FOREIGN = (
    (ReservedId.PUBLISHER, COMMAND[1]), (ReservedId.SUBSCRIBER, STATE[1]),
    (ReservedId.PUBLISHER, STATE[1]._replace(name="/jackal_velocity_controller/cmd_vel")),
    (ReservedId.PUBLISHER, STATE[1]._replace(type_name="mtr_msgs/Command", md5="b" * 32)))


@pytest.mark.parametrize("foreign", FOREIGN)
def test_topic_of_another_name_type_or_direction_is_not_served_and_told_once(foreign):  # F1
    line = Cable(foreign, expected=OURS).plug().run(20.0, line_message())
    assert not line.opened() and not line.session.endpoints.by_id
    refusals = [event.refused for event in line.events if event.refused]
    assert len(refusals) == 1 and foreign[1].name in refusals[0] and foreign[1].type_name in refusals[0]
    assert refusals[0][:MAX_REFUSAL_CHARACTERS] in line.session.health.refusals


def test_board_that_gives_a_topic_ever_new_ids_fills_no_memory():  # F2
    line = Cable(expected=OURS).plug()
    for topic_id in range(200, 1200):
        line.device.endpoints = [(ReservedId.PUBLISHER, STATE[1]._replace(topic_id=topic_id)), COMMAND]
        line.session.receive(line.device.receive(encode(SerialFrame(0, b""))), line.now_s)
    assert len(line.session.endpoints.by_id) == 2


def test_topic_that_cannot_be_served_lasts_until_it_is_described_otherwise_and_a_single_refusal_a_minute():
    line = Cable((ReservedId.PUBLISHER, STATE[1]._replace(md5="f" * 32)), COMMAND).plug().run(100.0, line_message())
    assert line.session.endpoints.refused
    line.device.endpoints = [STATE, COMMAND]
    line.session.receive(line.device.receive(encode(SerialFrame(0, b""))), line.now_s)
    assert not line.session.endpoints.refused
    assert not line.session.send("/command", bytes(21))
    assert line.session.health.has_refused_lately(line.now_s + REFUSAL_SHOWN_S - 1.0)
    assert not line.session.health.has_refused_lately(line.now_s + REFUSAL_SHOWN_S + 0.1)


def test_refusals_of_a_line_that_damages_texts_are_bounded():  # F2
    health = Cable().session.health
    kept = [health.add_refusal(f"{number} {'x' * 1000}") for number in range(1000)]
    assert sum(kept) == MAX_REFUSALS and len(health.refusals) == MAX_REFUSALS + 1
    assert health.refusals[OTHER_REFUSALS] == 1000 - MAX_REFUSALS
    assert max(map(len, health.refusals)) == MAX_REFUSAL_CHARACTERS
