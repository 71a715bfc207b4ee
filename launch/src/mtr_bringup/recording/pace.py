"""How fast a recording may be played: never faster than the nodes that decide anew have followed.

A player that keeps to the clock of a busy machine brings messages late and loses some, and the nodes then decide what
the machine made them decide.
"""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, field
from typing import Dict, List, Optional


@dataclass(frozen=True)
class Follower:
    """A node that answers what is played.

    Attributes:
        topic: where its answers appear.
        lag_s: how much older than what is played its newest answer may be, in recorded time; longer than its period,
            and of a node with ticks less than two: it leaves out a tick for which it is a period late, and then waits
            for a clock that waits for its answer.
        answers: topic whose stamps it answers one by one; empty when it speaks at its own ticks of the recorded clock.
    """

    topic: str
    lag_s: float
    answers: str = ""


@dataclass
class Pace:
    """Who is behind, and for how long the player has waited. Times: recorded ones in s, steady ones of this machine.

    Attributes:
        waited_s: steady time that the player has waited for each topic.
    """

    followers: List[Follower]
    patience_s: float
    waited_s: Dict[str, float] = field(default_factory=dict)
    _owed_s: Dict[str, float] = field(default_factory=dict)
    _answered_s: Dict[str, float] = field(default_factory=dict)
    _dropped: Dict[str, float] = field(default_factory=dict)

    def begin(self, clock_s: float) -> None:
        """The recorded clock starts here; nobody owes an answer to what was before."""
        self._answered_s = {follower.topic: clock_s for follower in self.followers}

    def played(self, topic: str, stamp_s: float) -> None:
        """A message with this stamp has gone out."""
        for follower in self.followers:
            if follower.answers == topic:
                self._owed_s[follower.topic] = stamp_s

    def answered(self, topic: str, stamp_s: float) -> None:
        """A follower has spoken; one that was given up counts again."""
        self._answered_s[topic] = stamp_s
        self._dropped.pop(topic, None)

    def behind(self, clock_s: float) -> Optional[str]:
        """The topic of a follower that has to catch up before the recorded clock goes on, None when none has to."""
        for follower in self.followers:
            owed_s = self._owed_s.get(follower.topic) if follower.answers else clock_s
            if owed_s is None or follower.topic in self._dropped:
                continue
            if self._answered_s[follower.topic] < owed_s - follower.lag_s:
                return follower.topic
        return None

    def has_waited(self, topic: str, waited_s: float, in_all_s: float) -> bool:
        """Count waited_s; True when the follower has now been silent for in_all_s, too long, and is given up."""
        self.waited_s[topic] = self.waited_s.get(topic, 0.0) + waited_s
        if in_all_s < self.patience_s:
            return False
        self._dropped[topic] = in_all_s
        return True
