"""Node that relays the hardware stop of the base; it needs no package of the base's messages."""
# SPDX-License-Identifier: Apache-2.0
import time
from typing import Any, Callable, Dict, Optional

import genpy.dynamic
import rospy
import std_msgs.msg

from mtr_core.lockstep import Ticker, publisher, run_node
from mtr_core.schedule import slot

from .judge import BaseStop, StopReport, stop_report
from .parameters import Parameters

# The base's own topic, and the one for drive control's e_stop_topics.
STATUS, STOP = "/status", "/base_stop"
BASE_STOP = slot(50, 45)


class StatusDecoder:
    """Decoder of messages of any type, by the definition that their publisher sends with the connection."""

    def __init__(self) -> None:
        self._types: Dict[str, Callable[[], Any]] = {}

    def report(self, header: Dict[str, str], data: bytes) -> Optional[StopReport]:
        """Return the report of a message; None for one that cannot be decoded. header: of its connection."""
        try:
            return stop_report(self._type(header)().deserialize(data))
        # A publisher may declare and send anything.
        except Exception as error:
            rospy.logwarn_throttle(30.0, "The status of the base cannot be decoded: %r.", error)
            return None

    def _type(self, header: Dict[str, str]) -> Callable[[], Any]:
        checksum = header["md5sum"]
        if checksum not in self._types:
            self._types[checksum] = genpy.dynamic.generate_dynamic(
                header["type"], header["message_definition"])[header["type"]]
        return self._types[checksum]


class BaseStopNode:
    """Publishes 20 times a second if the stop is engaged: drive control treats a silence of 0.25 s as a stop."""

    def __init__(self, parameters: Parameters):
        self._stop, self._decoder, self._logged = BaseStop(parameters.silent_after_s), StatusDecoder(), ""
        self._publisher = publisher(STOP, std_msgs.msg.Bool)
        self._subscriber = rospy.Subscriber(STATUS, rospy.AnyMsg, self._receive, queue_size=10, tcp_nodelay=True)
        self._ticker = Ticker(BASE_STOP)

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self._ticker.sleep()
            self._publish()

    def _receive(self, message: rospy.AnyMsg) -> None:
        report = self._decoder.report(message._connection_header, message._buff)
        self._stop.receive(report, time.monotonic())
        if report is not None and report.is_stopped:
            # A stop is published without waiting for the next tick.
            self._publish()

    def _publish(self) -> None:
        reason = self._stop.reason(time.monotonic())
        self._publisher.publish(std_msgs.msg.Bool(bool(reason)))
        if reason != self._logged:
            rospy.logwarn("%s", f"The robot is locked: {reason}." if reason else "The hardware stop is released.")
            self._logged = reason


def main() -> int:
    """Run the node; return its exit status."""
    return run_node("base_stop", Parameters, BaseStopNode)
