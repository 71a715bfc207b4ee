"""Holds of the control loop's nodes: the limit of the simulated clock, and the nodes for which it waits."""
# SPDX-License-Identifier: Apache-2.0
import threading
import time
from dataclasses import dataclass
from typing import Callable, Dict, Iterable, List, Optional, Set

# A node that blocks the clock and is silent for this wall time counts as dead.
SILENT_AFTER_WALL_S = 5.0
# Period in which the existence of a blocking node is checked.
LOOK_WALL_S = 0.1
STILL_WAITING_WALL_S = 10.0


@dataclass
class _Node:
    """State of one node: its newest hold, number of sent and received messages, and the time of its last sign of
    life."""

    stamp_ns: Optional[int] = None
    sent: int = 0
    received: int = 0
    received_s: float = 0.0
    dropped: bool = False

    def blocks(self, time_ns: int) -> bool:
        """Return True while the clock must not reach time_ns."""
        return self.stamp_ns is not None and (self.stamp_ns < time_ns or self.received < self.sent)


class Watcher:
    """Observer of the barrier; this one ignores all events."""

    def warn(self, sentence: str) -> None:
        """Handle a warning."""

    def dropped(self, name: str) -> None:
        """Handle a node for which the clock no longer waits."""

    def returned(self, name: str) -> None:
        """Handle a dropped node that has returned."""


class Barrier:
    """Thread-safe barrier; callbacks report, the simulator's loop waits.

    A repeated hold is a sign of life: a node that blocks the time for a reason repeats its hold. The clock does not
    wait for a node that has ended; its next instance counts as new.

    Attributes:
        waited_s: wall time for which the clock waited, by the last node.
    """

    def __init__(self, expected: Iterable[str], watcher: Watcher, wall_clock: Callable[[], float] = time.monotonic,
                 has_ended: Callable[[str], bool] = lambda name: False, silent_after_s: float = SILENT_AFTER_WALL_S):
        """has_ended: returns whether the process of a node with a hold has ended. silent_after_s: wall time."""
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
        """Set a node's hold: it works next at stamp_ns and has sent `sent` messages to the simulator."""
        with self._changed:
            node = self._nodes.setdefault(name, _Node())
            if node.dropped:
                node.dropped = False
                self._watcher.returned(name)
            if sent < node.sent:
                # The node counts from 0 again: it is a new instance without missing messages.
                node.received = sent
            node.stamp_ns, node.sent, node.received_s = stamp_ns, sent, self._wall_clock()
            self._came(name)

    def message(self, name: str) -> None:
        """Count a node's message that has arrived at the simulator."""
        with self._changed:
            self._nodes.setdefault(name, _Node()).received += 1
            self._came(name)

    def stop(self) -> None:
        """End every wait immediately."""
        with self._changed:
            self._stopped = True
            self._changed.notify_all()

    def missing(self) -> List[str]:
        """Return the expected nodes without a hold."""
        return [name for name in self._expected if name not in self._nodes or self._nodes[name].stamp_ns is None]

    def wait_for_expected(self) -> None:
        """Wait for a hold of each expected node; warn periodically about missing ones."""
        with self._changed:
            while not self._stopped and self.missing():
                if not self._changed.wait(STILL_WAITING_WALL_S):
                    self._watcher.warn(f"The clock stands still until it has heard of {', '.join(self.missing())}.")

    def wait(self, time_ns: int) -> bool:
        """Wait until the clock may advance to time_ns; return False when stopped."""
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
        """Return the nodes whose next work is later than time_ns."""
        with self._changed:
            return {name for name, node in self._nodes.items() if node.stamp_ns is not None and node.stamp_ns > time_ns}

    def longest_waits(self) -> str:
        """Describe for a person the nodes for which the clock waited longest."""
        with self._changed:
            waits = sorted(self.waited_s.items(), key=lambda item: -item[1])[:3]
        return "waited so far for " + (", ".join(f"{name} {seconds:.1f} s" for name, seconds in waits) or "nobody")

    def _came(self, name: str) -> None:
        """Register a sign of life of a node; wake the loop only when it no longer needs to wait."""
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
