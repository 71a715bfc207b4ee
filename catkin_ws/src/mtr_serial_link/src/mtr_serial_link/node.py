"""The serial bridge as a ROS node: the firmware's topics and services as if it were a node itself."""
# SPDX-License-Identifier: Apache-2.0
import threading
from dataclasses import dataclass

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from mtr_core.errors import check_range
from mtr_core.lockstep import run_node

from .connections import Connections, md5_of
from .line import Line, LineHandler, state_sentence
from .parameters import LinkParameters
from .port import SerialPort
from .session import Event, Session

LOG = (rospy.logdebug, rospy.loginfo, rospy.logwarn, rospy.logerr, rospy.logfatal)
DIAGNOSTICS_PERIOD_S = 1.0


@dataclass(frozen=True)
class BridgeParameters(LinkParameters):
    """Attributes:
        port: path of the board, best the one in /dev/serial/by-id, which stays with the board.
    """

    port: str = "/dev/serial/by-id/missing"

    def __post_init__(self) -> None:
        super().__post_init__()
        check_range("length of port", len(self.port), 1, 4096)


class SerialBridgeNode(LineHandler):
    """Owns the line, and serves in ROS what the device offers."""

    def __init__(self, parameters: BridgeParameters):
        self._parameters = parameters
        session = Session(parameters, md5_of, lambda: rospy.Time.now().to_nsec())
        self._line = Line(lambda: SerialPort(parameters.port, parameters.baud), session, self)
        self._connections = Connections(self._line.send, parameters.service_timeout_s)
        self._diagnostics = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=1)
        self._diagnosed_s = 0.0
        self._said = None
        self._stopped = threading.Event()

    def spin(self) -> None:
        """Run until shutdown."""
        rospy.on_shutdown(self._stopped.set)
        self._line.start()
        self._stopped.wait()
        self._line.stop()
        if not rospy.is_shutdown():
            raise RuntimeError("The thread of the serial line has ended.")

    def event(self, event: Event) -> None:
        """Something of the session; called in the line's thread."""
        if event.message:
            problem = self._connections.take(event.message)
            if problem:
                rospy.logwarn_throttle(1.0, problem)
        elif event.opened:
            info = event.opened.info
            rospy.loginfo("Firmware: %s, %s.", info.name, info.type_name)
            self._connections.open(event.opened)
        elif event.log:
            LOG[min(event.log.level, len(LOG) - 1)]("Firmware: %s", event.log.text)
        elif event.refused:
            rospy.logerr("%s", event.refused)

    def closed(self, reason: str) -> None:
        """The port is gone; called in the line's thread."""
        self._connections.close()

    def ended(self) -> None:
        """The line's thread ends; without it there is nothing left to do."""
        self._stopped.set()

    def tick(self, now_s: float) -> None:
        """Say what is wrong, once; called in the line's thread."""
        sentence = state_sentence(self._line, self._parameters.port, now_s)
        if sentence != self._said:
            if sentence:
                rospy.logwarn("%s", sentence)
            else:
                rospy.loginfo("The port %s is open at %d baud.", self._parameters.port, self._parameters.baud)
            self._said = sentence
        if now_s - self._diagnosed_s >= DIAGNOSTICS_PERIOD_S:
            self._diagnosed_s = now_s
            self._diagnostics.publish(self._diagnostics_message(sentence))

    def _diagnostics_message(self, sentence: str) -> DiagnosticArray:
        health = self._line.session.health
        values = {
            "bytes_received": health.bytes_in, "frames": health.frames,
            "checksum_errors": health.counts.checksum_errors, "skipped_bytes": health.counts.skipped_bytes,
            "unknown_topics": health.unknown_topics, "oversized_messages": health.oversized,
            "messages_without_topic": health.unroutable, "outrun_messages": self._line.dropped, **health.refusals,
        }
        status = DiagnosticStatus(
            level=_level(sentence, bool(health.refusals)), name=f"{rospy.get_name()}: serial line",
            message=sentence or "linked", hardware_id=self._parameters.port,
            values=[KeyValue(key, str(value)) for key, value in values.items()])
        message = DiagnosticArray(status=[status])
        message.header.stamp = rospy.Time.now()
        return message


def _level(sentence: str, has_refused: bool) -> bytes:
    if sentence:
        return DiagnosticStatus.ERROR
    return DiagnosticStatus.WARN if has_refused else DiagnosticStatus.OK


def main() -> int:
    """Run the node; its exit status."""
    return run_node("serial_bridge", BridgeParameters, SerialBridgeNode)
