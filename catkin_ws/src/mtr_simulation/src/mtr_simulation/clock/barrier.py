"""Holds of the control loop's nodes: how far the simulated clock may go, and who keeps it waiting."""
# SPDX-License-Identifier: Apache-2.0
import threading
import time
from dataclasses import dataclass
from typing import Callable, Dict, Iterable, List, Optional, Set

# A node that keeps the clock waiting and says nothing for this long (wall time) is taken for dead.
SILENT_AFTER_WALL_S = 5.0
# How often it is looked whether one that keeps the clock waiting still exists.
LOOK_WALL_S = 0.1
STILL_WAITING_WALL_S = 10.0


@dataclass
class _Node:
    """What is known of one node: its newest hold, messages that arrived from it, and when it was received last."""

    stamp_ns: Optional[int] = None
    sent: int = 0
    received: int = 0
    received_s: float = 0.0
    dropped: bool = False

    def blocks(self, time_ns: int) -> bool:
        """True while the clock must not reach time_ns."""
        return self.stamp_ns is not None and (self.stamp_ns < time_ns or self.received < self.sent)


class Watcher:
    """Who is told what happens; this one does not care."""

    def warn(self, sentence: str) -> None:
        """Something is wrong."""

    def dropped(self, name: str) -> None:
        """A node is not waited for any more."""

    def returned(self, name: str) -> None:
        """A node that was dropped speaks again."""


class Barrier:
    """Thread-safe; callbacks report, the simulator's loop waits.

    A repeated hold is a sign of life: a node that has reason to let time stand still says its hold again. One that has
    ended is not waited for; its next instance is as one that was never heard of.

    Attributes:
        waited_s: wall time that the clock waited, by the node that came last.
    """

    def __init__(self, expected: Iterable[str], watcher: Watcher, wall_clock: Callable[[], float] = time.monotonic,
                 has_ended: Callable[[str], bool] = lambda name: False, silent_after_s: float = SILENT_AFTER_WALL_S):
        """has_ended: tells of a node that has said a hold whether its process is gone. silent_after_s: of wall time."""
        self.waited_s: Dict[str, float] = {}
        self._expected = sorted(expected)
        self._watcher, self._wall_clock, self._has_ended = watcher, wall_clock, has_ended
        self._silent_after_s = silent_after_s
        self._changed = threading.Condition()
        self._nodes: Dict[str, _Node] = {}
        self._awaited_ns: Optional[int] = None
        self._last = ""
        self._stopped = False

    def hold(self, name: str, stamp_ns: int, sent: int) -> None:
        """A node works next at stamp_ns and has sent so many messages to the simulator."""
        with self._changed:
            node = self._nodes.setdefault(name, _Node())
            if node.dropped:
                node.dropped = False
                self._watcher.returned(name)
            if sent < node.sent:
                # It counts from 0 again: a new instance, of which nothing can be missing yet.
                node.received = sent
            node.stamp_ns, node.sent, node.received_s = stamp_ns, sent, self._wall_clock()
            self._came(name)

    def message(self, name: str) -> None:
        """A message of a node has arrived at the simulator."""
        with self._changed:
            self._nodes.setdefault(name, _Node()).received += 1
            self._came(name)

    def stop(self) -> None:
        """Let every wait end at once."""
        with self._changed:
            self._stopped = True
            self._changed.notify_all()

    def missing(self) -> List[str]:
        """Expected nodes that have not said a hold."""
        return [name for name in self._expected if name not in self._nodes or self._nodes[name].stamp_ns is None]

    def wait_for_expected(self) -> None:
        """Wait for a hold of each expected node; says now and then for whom."""
        with self._changed:
            while not self._stopped and self.missing():
                if not self._changed.wait(STILL_WAITING_WALL_S):
                    self._watcher.warn(f"The clock stands still until it has heard of {', '.join(self.missing())}.")

    def wait(self, time_ns: int) -> bool:
        """Wait until the clock may go to time_ns; False when stopped."""
        with self._changed:
            begun_s, self._awaited_ns = self._wall_clock(), time_ns
            while not self._stopped:
                name = self._blocker(time_ns)
                if name is None:
                    return True
                if self._has_ended(name):
                    self._watcher.warn(f"Node {name} has ended; time goes on without it.")
                    del self._nodes[name]
                    continue
                now_s = self._wall_clock()
                left_s = max(self._nodes[name].received_s, begun_s) + self._silent_after_s - now_s
                if left_s <= 0.0:
                    self._give_up(name, time_ns)
                    continue
                last = self._last if self._changed.wait(min(left_s, LOOK_WALL_S)) else name
                self.waited_s[last] = self.waited_s.get(last, 0.0) + self._wall_clock() - now_s
            return False

    def asleep(self, time_ns: int) -> Set[str]:
        """Nodes whose next work is later than time_ns."""
        with self._changed:
            return {name for name, node in self._nodes.items() if node.stamp_ns is not None and node.stamp_ns > time_ns}

    def longest_waits(self) -> str:
        """For whom the clock waited longest, for a person."""
        with self._changed:
            waits = sorted(self.waited_s.items(), key=lambda item: -item[1])[:3]
        return "waited so far for " + (", ".join(f"{name} {seconds:.1f} s" for name, seconds in waits) or "nobody")

    def _came(self, name: str) -> None:
        """Something came from a node; wakes the loop only when it need not wait any longer."""
        self._last = name
        if self._awaited_ns is None or self._blocker(self._awaited_ns) is None:
            self._changed.notify_all()

    def _blocker(self, time_ns: int) -> Optional[str]:
        for name, node in self._nodes.items():
            if node.blocks(time_ns):
                return name
        return None

    def _give_up(self, name: str, time_ns: int) -> None:
        node = self._nodes[name]
        if node.stamp_ns is not None and node.stamp_ns >= time_ns:
            self._watcher.warn(f"{node.sent - node.received} messages of node {name} were lost on their way to the "
                               "simulator; time goes on without them.")
            node.received = node.sent
        else:
            self._watcher.warn(f"Node {name} has been silent for {self._silent_after_s:g} s; time goes on without it.")
            node.stamp_ns, node.dropped = None, True
            self._watcher.dropped(name)
