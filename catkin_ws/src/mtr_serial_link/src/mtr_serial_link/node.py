"""ROS node of the serial bridge: publishes the firmware's topics and services as if it were a node."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import threading
import time
import xmlrpc.client
from dataclasses import dataclass
from typing import Tuple

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from mtr_core.errors import ConfigurationError, check_range
from mtr_core.lockstep import run_node
from mtr_core.quiet_log import Throttle

from .board_topics import FIRMWARE_TOPICS, board_topics
from .connections import Connections, md5_of
from .endpoints import Endpoint
from .line import LineObserver, SerialLine
from .parameters import SerialParameters
from .port import SerialPort
from .session import SerialSession, SessionEvent
from .status import LINKED, SerialLineStatus, Severity, StatusReports, line_status

LOG = (rospy.logdebug, rospy.loginfo, rospy.logwarn, rospy.logerr, rospy.logfatal)
# Longest logged text of the board in characters, and shortest period of log lines per level, s.
MAX_LOGGED, LOG_PERIOD_S = 200, 1.0
LEVELS = (DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR)
# Size for changes in quick succession, none of which may be lost.
DIAGNOSTICS_QUEUED = 10
MAX_TOPICS = 100
HOST = "builtin"


@dataclass(frozen=True)
class BridgeParameters(SerialParameters):
    """Parameters of the bridge.

    Attributes:
        port: path of the board, preferably in /dev/serial/by-id, which is permanent for a board.
        topics: allowed topics of the board, each "from NAME TYPE", "to NAME TYPE" or "service NAME TYPE"; by default
            the topics of the project's firmware.
        host: program that serves the line, as selected in robot.launch; only this one is available.
    """

    port: str = "/dev/serial/by-id/missing"
    topics: Tuple[str, ...] = FIRMWARE_TOPICS
    host: str = HOST

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.host != HOST:
            raise ConfigurationError(f"Parameter host is {self.host!r}; allowed is {HOST!r}: another program serves "
                                     "whatever topics the board names, the wheels' too.")
        check_range("length of port", len(self.port), 1, 4096)
        check_range("length of topics", len(board_topics(self.topics)), 1, MAX_TOPICS)


class SerialBridgeNode(LineObserver):
    """Owns the line and connects the device's topics and services with ROS."""

    def __init__(self, parameters: BridgeParameters):
        self._parameters, self._throttle = parameters, Throttle(LOG_PERIOD_S)
        session = SerialSession(parameters, md5_of, lambda: rospy.Time.now().to_nsec(),
                                board_topics(parameters.topics))
        self._line = SerialLine(lambda: SerialPort(parameters.port, parameters.baud), session, self)
        self._connections = Connections(self._line.send, parameters.service_timeout_s)
        self._diagnostics = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=DIAGNOSTICS_QUEUED)
        self._reports = StatusReports()
        self._logged = ""
        self._stopped = threading.Event()

    def spin(self) -> None:
        """Run until shutdown."""
        rospy.on_shutdown(self._stopped.set)
        self._line.start()
        self._stopped.wait()
        self._line.stop()
        if not rospy.is_shutdown():
            raise RuntimeError("The thread of the serial line has ended.")

    def event(self, event: SessionEvent) -> None:
        """Handle an event of the session; called in the line's thread."""
        if event.message:
            problem = self._connections.take(event.message)
            if problem:
                rospy.logwarn_throttle(1.0, problem)
        elif event.opened:
            self._open(event.opened)
        elif event.log:
            self._pass_on(min(event.log.level, len(LOG) - 1), event.log.text)
        elif event.refused:
            rospy.logerr("%s", event.refused)

    def _pass_on(self, level: int, text: str) -> None:
        """Log a text of the board; excessive logging is limited to one line per level and period."""
        said = self._throttle.passed(level, text[:MAX_LOGGED], time.monotonic())
        if said:
            LOG[level]("Firmware: %s", said)

    def _open(self, endpoint: Endpoint) -> None:
        info = endpoint.info
        rospy.loginfo("Firmware: %s, %s.", info.name, info.type_name)
        try:
            self._connections.open(endpoint)
        # Invalid name or type, or an unavailable master: other topics of the board are not affected.
        except (rospy.ROSException, ValueError, TypeError, OSError, xmlrpc.client.Error) as error:
            sentence = f"{info.name} of the firmware could not be served: {error}."
            if self._line.session.health.add_refusal(sentence):
                rospy.logerr("%s", sentence)

    def closed(self, reason: str) -> None:
        """Close all topics after the loss of the port; called in the line's thread."""
        self._connections.close()

    def ended(self) -> None:
        """Stop the node after the end of the line's thread."""
        self._stopped.set()

    def tick(self, now_s: float) -> None:
        """Publish the status of the line and log its changes; called in the line's thread."""
        session = self._line.session
        status = line_status(self._parameters.port, self._line.trouble, session.problem(now_s),
                             bool(session.endpoints.refused) or session.health.has_refused_lately(now_s),
                             session.missing)
        if self._reports.is_due(status, now_s):
            # During shutdown, the topic may be closed while the line still runs.
            with contextlib.suppress(rospy.ROSException):
                self._diagnostics.publish(self._diagnostics_message(status))
        if status.sentence != self._logged:
            self._logged = status.sentence
            self._log(status)

    def _log(self, status: SerialLineStatus) -> None:
        if status.sentence == LINKED:
            rospy.loginfo("The port %s is open at %d baud.", self._parameters.port, self._parameters.baud)
        elif status.severity is Severity.WARN:
            rospy.loginfo("%s", status.sentence)
        else:
            rospy.logwarn("%s", status.sentence)

    def _diagnostics_message(self, line: SerialLineStatus) -> DiagnosticArray:
        health = self._line.session.health
        values = {
            "bytes_received": health.bytes_in, "frames": health.frames,
            "checksum_errors": health.counts.checksum_errors, "skipped_bytes": health.counts.skipped_bytes,
            "unknown_topics": health.unknown_topics, "oversized_messages": health.oversized,
            "messages_without_topic": health.unroutable, "outrun_messages": self._line.dropped, **health.refusals,
        }
        status = DiagnosticStatus(
            level=LEVELS[line.severity], name=f"{rospy.get_name()}: serial line", message=line.sentence,
            hardware_id=self._parameters.port,
            values=[KeyValue(key, str(value)) for key, value in values.items()])
        message = DiagnosticArray(status=[status])
        message.header.stamp = rospy.Time.now()
        return message


def main() -> int:
    """Run the node and return its exit status."""
    return run_node("serial_bridge", BridgeParameters, SerialBridgeNode)
