"""Speed limit of the playback: never faster than the replayed nodes follow.

A player that keeps to the clock of a busy machine delivers late and loses messages, so that the decisions of the nodes
would depend on the machine.
"""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, field
from typing import Dict, List, NamedTuple, Optional, Set


class Follower(NamedTuple):
    """Node that answers messages one by one.

    Attributes:
        topic: topic of its answers.
        answers: topic whose stamps it answers.
        lag_ns: maximum delay of its newest answer relative to the playback, in recorded time.
    """

    topic: str
    answers: str
    lag_ns: int


@dataclass
class Pace:
    """Determines the late nodes, and the waiting time of the player. Times of the recording in ns, of this machine in
    s.

    Attributes:
        follower: node that answers messages.
        holders: nodes that work at ticks of the recorded clock and announce their next one, which the clock does not
            pass: a late node misses no tick.
        patience_s: silence after which a node is ignored.
        waited_s: for each topic or node.
    """

    follower: Follower
    holders: List[str]
    patience_s: float
    waited_s: Dict[str, float] = field(default_factory=dict)
    _owed_ns: Optional[int] = None
    _answered_ns: int = 0
    _held_ns: Dict[str, int] = field(default_factory=dict)
    _left: Set[str] = field(default_factory=set)

    def played(self, topic: str, stamp_ns: int) -> None:
        """Record that a message with this stamp was published."""
        if topic == self.follower.answers:
            self._owed_ns = stamp_ns

    def answered(self, stamp_ns: int) -> None:
        """Record an answer of the follower; if it was ignored it counts again."""
        self._answered_ns = stamp_ns
        self._left.discard(self.follower.topic)

    def held(self, node: str, tick_ns: int) -> None:
        """Record the next tick of a node; if it was ignored it counts again."""
        self._held_ns[node] = tick_ns
        self._left.discard(node)

    def next_ns(self, clock_ns: int, until_ns: int) -> int:
        """Return the next stop of the clock on its way to until_ns: no tick lies between."""
        return min([until_ns, *(tick_ns for tick_ns in self._held_ns.values() if tick_ns > clock_ns)])

    def behind(self, clock_ns: int) -> Optional[str]:
        """Return the topic or node that must catch up before the clock may pass this time, None without one."""
        names = [node for node in self.holders if self._held_ns.get(node, -1) <= clock_ns]
        if self._owed_ns is not None and self._answered_ns < self._owed_ns - self.follower.lag_ns:
            names.insert(0, self.follower.topic)
        return next((name for name in names if name not in self._left), None)

    def has_waited(self, name: str, waited_s: float, in_all_s: float) -> bool:
        """Add waited_s; return True if the silence has now reached in_all_s, after which the node is ignored."""
        self.waited_s[name] = self.waited_s.get(name, 0.0) + waited_s
        if in_all_s < self.patience_s:
            return False
        self._left.add(name)
        return True
