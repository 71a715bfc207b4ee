"""One rosserial session with a device, without port and ROS: bytes, times and messages in, bytes and events out.

Times are seconds of a monotonic clock; only the answer to the device's TIME request uses the robot's clock.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Callable, Dict, List, NamedTuple, Optional, Sequence, Set

from . import wire
from .board_topics import BoardTopic
from .endpoints import Endpoint, Endpoints
from .frames import FrameParser, SerialFrame, encode
from .health import LineHealth, LineProblem
from .parameters import SerialParameters

# A request occupies the line for a tenth of a second; unanswered ones are repeated with doubled periods up to this.
MAX_MISSING_PERIOD_S = 8.0
# Limit for stored names.
MAX_MISSED = 20


class SessionEvent(NamedTuple):
    """Event for the owner of the session; exactly one field is set."""

    opened: Optional[Endpoint] = None     # a topic or service of the device is known
    message: Optional[SerialFrame] = None       # a message of a known endpoint; topic_id is the endpoint's
    log: Optional[wire.LogLine] = None    # a log line of the device
    refused: str = ""                     # an endpoint was rejected, with the reason


class SerialSession:
    """Negotiates with the device, passes messages in both directions, and supervises the line.

    Attributes:
        endpoints: of the device, as far as described.
        missing: names of its topics that were requested again, because their description did not arrive intact.
        health: counters and the state of the line.
        outbox: bytes for the port, in order; the owner writes and removes them.
    """

    def __init__(self, parameters: SerialParameters, md5_of: Callable[[str], Optional[str]],
                 robot_clock_ns: Callable[[], int], expected: Sequence[BoardTopic] = ()):
        self._parameters = parameters
        self._robot_clock_ns = robot_clock_ns
        self._parser = FrameParser(parameters.max_payload_bytes)
        self._events: List[SessionEvent] = []
        self._asked_s = -math.inf
        self._byte_s = -math.inf
        self._missed: Set[str] = set()
        self._missing_period_s = parameters.ask_every_s
        self.missing: List[str] = []
        self.endpoints = Endpoints(md5_of, expected)
        self.health = LineHealth(parameters)
        self.outbox: List[bytes] = []

    def start(self, now_s: float) -> None:
        """Start negotiation after the port was opened."""
        self.health.start(now_s)
        self._missed.clear()
        self.missing, self._missing_period_s = [], self._parameters.ask_every_s
        self._ask(now_s)

    def receive(self, data: bytes, now_s: float) -> List[SessionEvent]:
        """Process bytes from the port and return the events."""
        # After a pause, an incomplete frame is given up: a device sends a frame without pauses.
        frames = self._parser.forget() if now_s - self._byte_s > self._parameters.frame_gap_s else []
        frames += self._parser.feed(data)
        self._byte_s = now_s
        for frame in frames:
            self._take(frame, now_s)
        self.health.add_bytes(len(data), self._parser.counts, now_s)
        return self._flush()

    def tick(self, now_s: float) -> List[SessionEvent]:
        """Must be called at least ten times per second: requests topics from a silent device and returns events."""
        if self._parser.has_partial_frame and now_s - self._byte_s > self._parameters.frame_gap_s:
            for frame in self._parser.forget():
                self._take(frame, now_s)
            self.health.add_bytes(0, self._parser.counts, now_s)
        has_gap = self.problem(now_s) is not LineProblem.NONE or not self.endpoints.by_id
        if has_gap and now_s - self._asked_s >= self._parameters.ask_every_s:
            self._ask(now_s)
        self._look_for_missing(now_s)
        return self._flush()

    def send(self, name: str, payload: bytes) -> bool:
        """Send a message to the device.

        Returns False, and counts it, if the topic is unknown or the message too long.
        """
        endpoint = self.endpoints.to_device.get(name)
        if endpoint is None or len(payload) > endpoint.info.buffer_bytes:
            self.health.add_dropped(name, len(payload), endpoint.info.buffer_bytes if endpoint else None)
            if endpoint is None and len(self._missed) < MAX_MISSED:
                self._missed.add(name)
            return False
        self._put(SerialFrame(endpoint.info.topic_id, payload))
        return True

    def stop(self) -> None:
        """Send a stop message to the device."""
        self._put(SerialFrame(wire.ReservedId.STOP, b""))

    def problem(self, now_s: float) -> LineProblem:
        """Return the problem of the line."""
        return self.health.problem(now_s)

    def _take(self, frame: SerialFrame, now_s: float) -> None:
        self.health.add_frame(now_s)
        take = self._RESERVED.get(frame.topic_id)
        try:
            if take:
                take(self, frame, now_s)
            elif frame.topic_id in self.endpoints.by_id:
                self._events.append(SessionEvent(message=frame))
            else:
                self._unknown(now_s)
        except wire.WireError as error:
            self.health.add_refusal(str(error))

    def _take_info(self, frame: SerialFrame, _: float) -> None:
        endpoint, refusal = self.endpoints.add(wire.ReservedId(frame.topic_id), wire.decode_topic_info(frame.payload))
        if refusal and self.health.add_refusal(refusal):
            self._events.append(SessionEvent(refused=refusal))
        if endpoint:
            self._events.append(SessionEvent(opened=endpoint))

    def _take_time(self, frame: SerialFrame, now_s: float) -> None:
        self._put(SerialFrame(wire.ReservedId.TIME, wire.encode_time(self._robot_clock_ns())))

    def _take_log(self, frame: SerialFrame, _: float) -> None:
        self._events.append(SessionEvent(log=wire.decode_log(frame.payload)))

    def _take_parameter(self, frame: SerialFrame, _: float) -> None:
        self.health.add_refusal("The firmware asks for a parameter; this bridge serves none.")

    def _unknown(self, now_s: float) -> None:
        """Request topics: the device continues an earlier session, or its description was lost."""
        self.health.unknown_topics += 1
        if now_s - self._asked_s >= self._parameters.ask_every_s:
            self._ask(now_s)

    def _look_for_missing(self, now_s: float) -> None:
        """Request a topic again after a corrupt description, which is not noticeable otherwise."""
        self._missed -= set(self.endpoints.to_device)
        missing = sorted(self._missed.union(self.endpoints.missing()))
        if not missing:
            self.missing, self._missing_period_s = [], self._parameters.ask_every_s
        elif self.endpoints.by_id and now_s - self._asked_s >= self._missing_period_s:
            self.missing = missing
            self._missing_period_s = min(2.0 * self._missing_period_s, MAX_MISSING_PERIOD_S)
            self._ask(now_s)

    def _ask(self, now_s: float) -> None:
        self._asked_s = now_s
        self._put(SerialFrame(wire.ReservedId.PUBLISHER, b""))

    def _put(self, frame: SerialFrame) -> None:
        self.outbox.append(encode(frame))

    def _flush(self) -> List[SessionEvent]:
        events, self._events = self._events, []
        return events

    _RESERVED: Dict[int, Callable[["SerialSession", SerialFrame, float], None]] = {
        wire.ReservedId.PUBLISHER: _take_info, wire.ReservedId.SUBSCRIBER: _take_info,
        wire.ReservedId.SERVICE_RESPONSE: _take_info, wire.ReservedId.SERVICE_REQUEST: _take_info,
        wire.ReservedId.PARAMETER: _take_parameter, wire.ReservedId.LOG: _take_log, wire.ReservedId.TIME: _take_time,
    }
