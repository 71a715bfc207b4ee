"""Topics and services of a device, checked against the host's message definitions."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, Dict, List, NamedTuple, Optional, Sequence, Set, Tuple

from .board_topics import DIRECTION_OF, BoardTopic
from .wire import ReservedId, TopicInfo

# Limit for stored names, because names may be corrupt.
MAX_REFUSED = 20


class Endpoint(NamedTuple):
    """One direction of a topic or service, given by kind."""

    kind: ReservedId
    info: TopicInfo


class Endpoints:
    """Endpoints that the device has described so far.

    Attributes:
        by_id: endpoints by their topic id.
        refused: kinds and names that are rejected as presently described.
        to_device: endpoints that receive from the host (subscribed topics, service requests), by name.
    """

    def __init__(self, md5_of: Callable[[str], Optional[str]], expected: Sequence[BoardTopic] = ()):
        """Create the table. With expected topics, only these are accepted; otherwise all with a known type."""
        self._md5_of = md5_of
        self._expected = frozenset(expected)
        self._described: Set[BoardTopic] = set()
        self.by_id: Dict[int, Endpoint] = {}
        self.to_device: Dict[str, Endpoint] = {}
        self.refused: Set[Tuple[ReservedId, str]] = set()

    def add(self, kind: ReservedId, info: TopicInfo) -> Tuple[Optional[Endpoint], str]:
        """Add a description.

        Returns:
            The endpoint if it is new or has changed, and a sentence if it is rejected.
        """
        refusal = self._refusal(kind, info)
        if refusal:
            if len(self.refused) < MAX_REFUSED:
                self.refused.add((kind, info.name))
            return None, refusal
        self.refused.discard((kind, info.name))
        endpoint = Endpoint(kind, info)
        if self.by_id.get(info.topic_id) == endpoint:
            return None, ""
        # Each topic has one id, so that a board cannot exhaust the memory with new ids.
        self.by_id = {topic_id: known for topic_id, known in self.by_id.items()
                      if (known.kind, known.info.name) != (kind, info.name)}
        self.by_id[info.topic_id] = endpoint
        if kind in (ReservedId.SUBSCRIBER, ReservedId.SERVICE_REQUEST):
            self.to_device[info.name] = endpoint
        return endpoint, ""

    def missing(self) -> List[str]:
        """Return the names of expected topics without a description so far."""
        return sorted({topic.name for topic in self._expected - self._described})

    def clear(self) -> None:
        """Clear all descriptions, because another device may be connected."""
        self._described.clear()
        self.refused.clear()
        self.by_id.clear()
        self.to_device.clear()

    def _refusal(self, kind: ReservedId, info: TopicInfo) -> str:
        topic = BoardTopic(DIRECTION_OF[kind], info.name, info.type_name)
        if self._expected and topic not in self._expected:
            return (f"The board offers {info.name}, {info.type_name}, direction {topic.direction.value}, which this "
                    "machine does not serve; is it the right board?")
        self._described.add(topic)
        part = {ReservedId.SERVICE_REQUEST: "Request", ReservedId.SERVICE_RESPONSE: "Response"}.get(kind, "")
        ours = self._md5_of(info.type_name + part)
        if ours is None:
            return (f"The firmware's {info.name} is a {info.type_name}, which this machine does not know; "
                    "build the firmware and the workspace from the same source.")
        if ours != info.md5:
            return (f"The firmware's {info.name} uses another {info.type_name} (checksum {info.md5}) than this machine "
                    f"({ours}); build the firmware and the workspace from the same source and flash it.")
        return ""
