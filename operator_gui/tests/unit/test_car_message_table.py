"""What comes over the bus, message by message."""
# SPDX-License-Identifier: Apache-2.0
import can
import pytest

from mtr_operator.car_link.bus import CanCarLink
from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.message_table import MAX_MESSAGES, MessageTable
from mtr_operator.car_link.profile import load_profile


def fed(table, can_id, times_s, *, data=b"\x01", is_extended=False):
    for time_s in times_s:
        table.frame(CanFrame(can_id, is_extended, data, time_s))


def test_message_tells_count_cycle_age_and_newest_data():
    table = MessageTable({(0x320, False): "Locks"})
    fed(table, 0x320, [0.0, 0.1])
    fed(table, 0x320, [0.2], data=b"\x02\x03")
    [message] = table.messages(0.7).messages
    assert (message.name, message.count, message.data) == ("Locks", 3, b"\x02\x03")
    assert message.cycle_s == pytest.approx(0.1)
    assert message.age_s == pytest.approx(0.5)


def test_one_frame_has_no_cycle_and_an_unknown_message_no_name():
    table = MessageTable()
    fed(table, 0x100, [1.0])
    [message] = table.messages(1.0).messages
    assert (message.cycle_s, message.name, message.age_s) == (None, "", 0.0)


def test_cycle_is_that_of_now():
    table = MessageTable()
    fed(table, 0x100, [index * 1.0 for index in range(30)])
    fed(table, 0x100, [29.0 + index * 0.1 for index in range(1, 31)])
    assert table.messages(32.0).messages[0].cycle_s == pytest.approx(0.1)


def test_messages_are_told_by_identifier_and_its_length():
    table = MessageTable()
    for can_id, is_extended in ((0x200, False), (0x100, True), (0x100, False)):
        fed(table, can_id, [0.0], is_extended=is_extended)
    assert [(each.can_id, each.is_extended) for each in table.messages(1.0).messages] == \
        [(0x100, False), (0x100, True), (0x200, False)]


def test_a_flood_of_identifiers_is_counted_and_not_kept():
    table = MessageTable()
    for can_id in range(MAX_MESSAGES + 3):
        fed(table, can_id, [0.0, 1.0], is_extended=True)
    told = table.messages(1.0)
    assert (len(told.messages), told.others) == (MAX_MESSAGES, 6)
    assert {each.count for each in told.messages} == {2}


def test_shipped_profile_names_every_message_of_its_database():
    profile = load_profile("mtr_demo_car")
    assert profile.message_names[(profile.message.frame_id, False)] == profile.message.name
    assert len(profile.message_names) > 1


def test_link_tells_the_messages_of_its_bus(tmp_path):
    link = CanCarLink("virtual", str(tmp_path), clock=lambda: 0.0)
    assert link.messages.messages == ()
    link.connect()
    with can.Bus(interface="virtual", channel=str(tmp_path)) as bus:
        bus.send(can.Message(arbitration_id=0x123, is_extended_id=False, data=[7]))
        with link._changed:
            assert link._changed.wait_for(lambda: link.messages.messages, 5.0)
    link.close()
    [message] = link.messages.messages
    assert (message.can_id, message.count, message.data) == (0x123, 1, b"\x07")
