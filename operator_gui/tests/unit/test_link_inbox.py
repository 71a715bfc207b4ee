"""What becomes of a Status between the socket and the runner."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.domain.ports import LinkStatistics
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.robot_link.conversions import MAX_MESSAGE_BYTES, status_message_from
from mtr_operator.robot_link.inbox import MAX_BACKLOG, RESTARTED, Inbox


class Mail:
    """An inbox and its statistics."""

    def __init__(self):
        self.statistics = LinkStatistics()
        self.inbox = Inbox(self.statistics)

    def put(self, status_id, robot_session_id=1):
        """A Status has come; True when it repeats the one that was taken last."""
        status = RobotStatus(status_id, robot_session_id, status_id / 10)
        return self.inbox.put([status_message_from(status).SerializeToString()])

    def taken(self):
        """All that wait."""
        return list(iter(self.inbox.take, None))


@pytest.fixture(name="mail")
def mail_fixture():
    """A new one."""
    return Mail()


def test_each_status_is_received_once(mail):
    assert [mail.put(1), mail.put(2)] == [False, False]
    assert [status.id for status in mail.taken()] == [1, 2]
    assert mail.statistics.received == 2


def test_only_the_status_that_was_taken_last_is_a_repetition(mail):
    mail.put(1)
    mail.put(2)
    assert not mail.put(2)
    mail.taken()
    assert mail.put(2) and not mail.put(1)
    assert mail.taken() == []


def test_status_that_cannot_be_read_is_no_repetition(mail):
    assert not mail.inbox.put([b"\xff"])
    assert mail.statistics.undecodable == 1


@pytest.mark.parametrize("size, oversized", [(MAX_MESSAGE_BYTES, 0), (MAX_MESSAGE_BYTES + 1, 1)])
def test_message_beyond_the_limit_is_oversized(mail, size, oversized):
    mail.inbox.put([bytes(size)])
    assert (mail.statistics.oversized, mail.statistics.undecodable) == (oversized, 1 - oversized)


@pytest.mark.parametrize("restarts_at, told", [(None, 0), (3, 1), (MAX_BACKLOG + 1, 1)])
def test_restart_is_told_once_though_the_backlog_is_skipped(mail, restarts_at, told):
    mail.put(1)
    for status_id in range(2, MAX_BACKLOG + 2):
        mail.put(status_id, 1 if restarts_at is None or status_id < restarts_at else 2)
    newest, = mail.taken()
    assert newest.id == MAX_BACKLOG + 1 and newest.notifications.count(RESTARTED) == told
