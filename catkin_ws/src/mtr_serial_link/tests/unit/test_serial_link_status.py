"""The status of the line is reported at each change, and never better than it is."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_serial_link.fake_device import FakeSerialDevice
from mtr_serial_link.health import LineProblem
from mtr_serial_link.line import TICK_S
from mtr_serial_link.parameters import SerialParameters
from mtr_serial_link.session import SerialSession
from mtr_serial_link.status import LINKED, SerialLineStatus, Severity, StatusReports, line_status
from mtr_serial_link.wire import ReservedId, TopicInfo

PORT = "/dev/board"
STATE = (ReservedId.PUBLISHER, TopicInfo(125, "/state", "mtr_msgs/State", "a" * 32, 280))
MD5 = {"mtr_msgs/State": "a" * 32}
# Time from a request to its answer.
ANSWER_S = 0.002
# Duration of an iteration without an answer: poll() never returns early.
TURN_S = TICK_S + 0.0001


def test_topic_that_is_missing_is_told_and_is_a_warning():  # N1
    status = line_status(PORT, "", LineProblem.NONE, has_refused=False, missing=["/press", "/state"])
    assert status.severity is Severity.WARN and "/press, /state" in status.sentence
    assert line_status(PORT, "", LineProblem.LOST, False, ["/press"]).severity is Severity.ERROR


class Course:
    """Iterations of a line with a device that answers requests only, on a simulated clock.

    Attributes:
        reported: (time in s, status) of each report.
    """

    def __init__(self):
        self.device = FakeSerialDevice([STATE])
        self.session = SerialSession(SerialParameters(), MD5.get, lambda: 0)
        self.reported = []
        self._reports = StatusReports()
        self._now_s = 0.0
        self.session.start(0.0)

    def run(self, until_s, frozen=False):
        """Run iterations; each ends when the device has answered, or after TURN_S."""
        while self._now_s < until_s:
            to_device, self.session.outbox[:] = b"".join(self.session.outbox), []
            answer = b"" if frozen or not to_device else self.device.receive(to_device)
            self._now_s += ANSWER_S if answer else TURN_S
            if answer:
                self.session.receive(answer, self._now_s)
            self.session.tick(self._now_s)
            status = line_status(PORT, "", self.session.problem(self._now_s), False)
            if self._reports.is_due(status, self._now_s):
                self.reported.append((self._now_s, status))
        return self

    def sentences(self, since_s=0.0):
        """Return the sentences reported from then on."""
        return [status.sentence for reported_s, status in self.reported if reported_s >= since_s]


@pytest.mark.parametrize("thaw_s", [5.0 + 0.01 * step for step in range(200)])
def test_device_that_thaws_at_any_instant_is_called_linked(thaw_s):
    course = Course().run(3.0).run(thaw_s, frozen=True).run(thaw_s + 10.0)
    assert LINKED in course.sentences(thaw_s)


def test_each_change_is_reported_in_its_turn_and_nothing_twice_within_a_period():
    reports = StatusReports(1.0)
    linked, lost = SerialLineStatus(Severity.OK, LINKED), SerialLineStatus(Severity.ERROR, "It is lost.")
    course = [(0.0, linked), (0.1, linked), (0.9, lost), (0.902, linked), (1.8, linked), (1.903, linked)]
    assert [reports.is_due(status, now_s) for now_s, status in course] == [True, False, True, True, False, True]


def test_port_is_not_called_linked_before_the_device_has_spoken():
    mute = Course().run(5.0, frozen=True)
    assert LINKED not in mute.sentences()
    assert mute.sentences()[0] == "The port /dev/board is open and waits for the board's first message."
    assert "is open but silent" in mute.sentences()[-1]


@pytest.mark.parametrize("trouble, problem, has_refused, status", [
    ("", LineProblem.NONE, False, (Severity.OK, LINKED)),
    ("", LineProblem.NONE, True, (Severity.WARN, LINKED)),
    ("", LineProblem.WAITING, False, (Severity.WARN, f"The port {PORT} {LineProblem.WAITING.value}.")),
    ("", LineProblem.LOST, True, (Severity.ERROR, f"The port {PORT} {LineProblem.LOST.value}.")),
    ("The port is busy.", LineProblem.NONE, False, (Severity.ERROR, "The port is busy.")),
])
def test_status_says_the_worst(trouble, problem, has_refused, status):
    assert line_status(PORT, trouble, problem, has_refused) == status
