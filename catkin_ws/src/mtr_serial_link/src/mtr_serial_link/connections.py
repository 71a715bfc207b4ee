"""ROS topics and services for the endpoints of a device."""
# SPDX-License-Identifier: Apache-2.0
import io
import threading
import time
from typing import Any, Callable, Dict, Optional

import genpy
import roslib.message
import rospy

from .calls import Calls, CallState
from .endpoints import Endpoint
from .frames import SerialFrame
from .wire import ReservedId

SERVICE_PARTS = {"Request": "_request_class", "Response": "_response_class"}
# Margin for a final check of the condition at the end of a call's time limit.
CALL_MARGIN_S = 0.05


def class_of(type_name: str) -> Optional[Any]:
    """Return the class of a message, or of a service part (name ends in Request or Response); None if unknown."""
    for part, attribute in SERVICE_PARTS.items():
        if type_name.endswith(part):
            service = _service_of(type_name[:-len(part)])
            if service:
                return getattr(service, attribute)
    try:
        return roslib.message.get_message_class(type_name)
    except (ImportError, ValueError, AttributeError):
        return None


def md5_of(type_name: str) -> Optional[str]:
    """Return the checksum of the local definition."""
    found = class_of(type_name)
    return found._md5sum if found else None


def bytes_of(message: Any) -> bytes:
    """Serialize a message in ROS format, which is also rosserial's payload."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


class Connections:
    """Publishers, subscribers and services, opened from the device's descriptions and closed with its port."""

    def __init__(self, send: Callable[[str, bytes], None], service_timeout_s: float):
        self._send = send
        self._service_timeout_s = service_timeout_s
        self._publishers: Dict[int, Any] = {}
        self._subscribers: Dict[str, Any] = {}
        self._services: Dict[str, ServiceBridge] = {}
        self._responses: Dict[int, ServiceBridge] = {}

    def open(self, endpoint: Endpoint) -> None:
        """Open a topic or service for an endpoint."""
        kind, info = endpoint
        if kind is ReservedId.PUBLISHER:
            self._close_publishers(info.name)
            self._publishers[info.topic_id] = rospy.Publisher(info.name, class_of(info.type_name), queue_size=50,
                                                              tcp_nodelay=True)
        elif kind is ReservedId.SUBSCRIBER:
            self._close_subscriber(info.name)
            self._subscribers[info.name] = rospy.Subscriber(
                info.name, class_of(info.type_name), lambda message: self._send(info.name, bytes_of(message)),
                queue_size=4, tcp_nodelay=True)
        else:
            if info.name not in self._services:
                self._services[info.name] = ServiceBridge(info.name, _service_of(info.type_name), self._send,
                                                          self._service_timeout_s)
            if kind is ReservedId.SERVICE_RESPONSE:
                self._responses[info.topic_id] = self._services[info.name]

    def take(self, frame: SerialFrame) -> str:
        """Publish a message of the device; return a sentence if its bytes are invalid, otherwise an empty text."""
        if frame.topic_id in self._responses:
            self._responses[frame.topic_id].take(frame.payload)
            return ""
        publisher = self._publishers.get(frame.topic_id)
        if publisher is None:
            return ""
        message = publisher.data_class()
        try:
            message.deserialize(frame.payload)
        except genpy.DeserializationError as error:
            return f"A message on {publisher.name} of {len(frame.payload)} bytes could not be read: {error}."
        try:
            publisher.publish(message)
        except rospy.ROSException as error:
            return f"A message on {publisher.name} could not be published: {error}."
        return ""

    def close(self) -> None:
        """Close all topics and services."""
        for publisher in self._publishers.values():
            publisher.unregister()
        for name in list(self._subscribers):
            self._close_subscriber(name)
        for service in self._services.values():
            service.close()
        self._publishers.clear()
        self._services.clear()
        self._responses.clear()

    def _close_publishers(self, name: str) -> None:
        for topic_id in [each for each, publisher in self._publishers.items() if publisher.name == name]:
            self._publishers.pop(topic_id).unregister()

    def _close_subscriber(self, name: str) -> None:
        former = self._subscribers.pop(name, None)
        if former:
            former.unregister()


class ServiceBridge:
    """ROS service for a service of the device; an unanswered call fails at its time limit."""

    def __init__(self, name: str, service: Any, send: Callable[[str, bytes], None], timeout_s: float):
        self._name, self._send, self._timeout_s = name, send, timeout_s
        self._calls = Calls(timeout_s)
        self._changed = threading.Condition()
        self._closed = False
        self._response_class = service._response_class
        self._service = rospy.Service(name, service, self._call)

    def take(self, payload: bytes) -> None:
        """Accept an answer of the device."""
        with self._changed:
            self._calls.take(payload, time.monotonic())
            self._changed.notify_all()

    def close(self) -> None:
        """Fail pending calls and close the service."""
        with self._changed:
            self._closed = True
            self._calls.abort()
            self._changed.notify_all()
        self._service.shutdown("the firmware's port is gone")

    def _call(self, request: Any) -> Any:
        with self._changed:
            refusal = self._calls.begin(time.monotonic())
            if refusal:
                raise rospy.ServiceException(f"{self._name} of the firmware cannot be called: {refusal}.")
            self._send(self._name, bytes_of(request))
            self._changed.wait_for(lambda: self._closed or self._calls.state(time.monotonic()) is not CallState.WAITING,
                                   self._timeout_s + CALL_MARGIN_S)
            if self._closed or self._calls.state(time.monotonic()) is not CallState.ANSWERED:
                raise rospy.ServiceException(f"{self._name} of the firmware did not answer within "
                                             f"{self._timeout_s:g} s.")
            return self._response_class().deserialize(self._calls.answer)


def _service_of(type_name: str) -> Optional[Any]:
    try:
        return roslib.message.get_service_class(type_name)
    except (ImportError, ValueError, AttributeError):
        return None
