"""How fast a recording may be played: never faster than the nodes that decide anew have followed.

A player that keeps to the clock of a busy machine brings messages late and loses some, and the nodes then decide what
the machine made them decide.
"""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, field
from typing import Dict, List, NamedTuple, Optional, Set


class Follower(NamedTuple):
    """A node that answers messages one by one.

    Attributes:
        topic: where its answers appear.
        answers: topic whose stamps it answers.
        lag_ns: how much older than what is played its newest answer may be, in recorded time.
    """

    topic: str
    answers: str
    lag_ns: int


@dataclass
class Pace:
    """Who is behind, and for how long the player has waited. Times of the recording in ns, of this machine in s.

    Attributes:
        follower: node that answers messages.
        holders: nodes that work at ticks of the recorded clock and say their next one beforehand, which the clock does
            not pass: one that is late leaves no tick out.
        patience_s: a node that is silent for so long is left behind.
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
        """A message with this stamp has gone out."""
        if topic == self.follower.answers:
            self._owed_ns = stamp_ns

    def answered(self, stamp_ns: int) -> None:
        """The follower has spoken; if it was left behind it counts again."""
        self._answered_ns = stamp_ns
        self._left.discard(self.follower.topic)

    def held(self, node: str, tick_ns: int) -> None:
        """A node works next at this tick; if it was left behind it counts again."""
        self._held_ns[node] = tick_ns
        self._left.discard(node)

    def next_ns(self, clock_ns: int, until_ns: int) -> int:
        """Where the clock stops on its way to until_ns: no tick lies between."""
        return min([until_ns, *(tick_ns for tick_ns in self._held_ns.values() if tick_ns > clock_ns)])

    def behind(self, clock_ns: int) -> Optional[str]:
        """Topic or node that has to catch up before the clock may go on from this time, None when none has to."""
        names = [node for node in self.holders if self._held_ns.get(node, -1) <= clock_ns]
        if self._owed_ns is not None and self._answered_ns < self._owed_ns - self.follower.lag_ns:
            names.insert(0, self.follower.topic)
        return next((name for name in names if name not in self._left), None)

    def has_waited(self, name: str, waited_s: float, in_all_s: float) -> bool:
        """Count waited_s; True when it has now been silent for in_all_s, too long, and is left behind."""
        self.waited_s[name] = self.waited_s.get(name, 0.0) + waited_s
        if in_all_s < self.patience_s:
            return False
        self._left.add(name)
        return True
