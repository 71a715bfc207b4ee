"""Watch for topics that must have exactly one publisher, such as the inputs that move the robot."""
# SPDX-License-Identifier: Apache-2.0
import http.client
import threading
import time
import xmlrpc.client
from typing import Any, Dict, FrozenSet, Iterable, Mapping, NamedTuple, Optional, Sequence, Tuple

import rosgraph
import rospy

PERIOD_WALL_S = 1.0
# Any node may be the publisher, but only one.
ANY_NODE = ""


class Intruder(NamedTuple):
    """A node that publishes on a topic of another node."""

    node: str
    topic: str


class SolePublishers:
    """Decides from the master's list which node may publish on each watched topic.

    Attributes:
        intruder: the first node found on a topic of another node, or None.
    """

    def __init__(self, permitted: Mapping[str, str]):
        """permitted: full node name by full topic name; ANY_NODE accepts the first node that publishes."""
        self._permitted = dict(permitted)
        self._known: Dict[str, str] = {topic: node for topic, node in permitted.items() if node != ANY_NODE}
        self._publishers: Optional[Dict[str, FrozenSet[str]]] = None
        self.intruder: Optional[Intruder] = None

    def update(self, publishers: Iterable[Tuple[str, Sequence[str]]]) -> None:
        """Process the master's list of (topic, nodes that publish on it)."""
        found = {topic: frozenset(nodes) for topic, nodes in publishers}
        self._publishers = {topic: found.get(topic, frozenset()) for topic in self._permitted}
        intruders = (self._intruder_on(topic, nodes) for topic, nodes in self._publishers.items())
        self.intruder = next((each for each in intruders if each), None)

    def permits(self, topic: str, node: str) -> bool:
        """Return True if a message of this node may be used; a new node waits for an update."""
        if self._permitted[topic] != ANY_NODE:
            return node == self._permitted[topic]
        return self._publishers is None or self._publishers[topic] == {node}

    def _intruder_on(self, topic: str, nodes: FrozenSet[str]) -> Optional[Intruder]:
        known = self._known.get(topic, "")
        if self._permitted[topic] == ANY_NODE and known not in nodes:
            known = next(iter(nodes)) if len(nodes) == 1 else ""
            self._known[topic] = known
        others = sorted(nodes - {known})
        return Intruder(" and ".join(others), topic) if others else None


class PublisherWatch:
    """Queries the ROS master once a second for the publishers of the watched topics.

    It uses a thread, because a slow master must not delay a tick. While the master does not answer, its last answer
    remains in force. Drive control has the same watch for the wheels (publisher_watch.hpp).
    """

    def __init__(self, permitted: Mapping[str, str]):
        """Query once, then start the thread. permitted: node name by topic name, ANY_NODE for any single node."""
        self._resolved = {topic: rospy.resolve_name(topic) for topic in permitted}
        # Node names are not remapped: resolve_name would apply the remapping of a topic with the same name.
        self._sole = SolePublishers({self._resolved[topic]: node and f"/{node.lstrip('/')}"
                                     for topic, node in permitted.items()})
        self._look()
        threading.Thread(target=self._run, name="publisher watch", daemon=True).start()

    @property
    def intruder(self) -> Optional[Intruder]:
        """A node that must be ended before the robot may move, or None."""
        return self._sole.intruder

    def permits(self, topic: str, message: Any) -> bool:
        """Return True if a received message is from the node that may publish on the topic."""
        return self._sole.permits(self._resolved[topic], message._connection_header["callerid"])

    def _run(self) -> None:
        while not rospy.is_shutdown():
            time.sleep(PERIOD_WALL_S)
            self._look()

    def _look(self) -> None:
        try:
            publishers, _, _ = rosgraph.Master(rospy.get_name()).getSystemState()
        except (OSError, http.client.HTTPException, xmlrpc.client.Error, rosgraph.MasterException) as error:
            rospy.logwarn_throttle(30.0, f"The ROS master does not list its publishers: {error}.")
            return
        self._sole.update(publishers)
