"""A topic whose messages are all processed, in order, at the ticks of a node."""
# SPDX-License-Identifier: Apache-2.0
import threading
import time
from collections import deque
from typing import Any, Deque, List, Optional

import rospy

from mtr_core.schedule import MILLISECOND_NS, Slot

from .clock import is_lockstep
from .patience import patience_at_least_s, patience_s
from .samples import Samples

# Limit of the wait for a publisher's connection (wall time).
CONNECT_WITHIN_WALL_S = 2.0
CONNECT_CHECK_WALL_S = 0.005
# The first messages after a new connection may be missing.
SETTLING_NS = 200 * MILLISECOND_NS
KEPT = 100


class StampedQueue:
    """Subscription that stores messages with a header until they are taken.

    In lock-step the constructor waits for the connection, and `take` for the message that is due, so that the result
    does not depend on the speed of the machine. A message is due lag_ns after its stamp.
    """

    def __init__(self, topic: str, message_type: Any, slot: Slot, lag_ns: int):
        self._lag_ns = lag_ns
        self._samples: Samples[Any] = Samples(slot, lag_ns, waits=is_lockstep())
        self._queue: Deque[Any] = deque(maxlen=KEPT)
        self._changing = threading.Lock()
        # Newest tick without a connection; the first tick if it was connected from the start.
        self._connected_ns: Optional[int] = None
        self._subscriber = rospy.Subscriber(topic, message_type, self._take_in, queue_size=50, tcp_nodelay=True)
        if is_lockstep():
            self._samples.patience_s = patience_s()
            self._connect(topic)

    def take(self, tick_ns: int) -> List[Any]:
        """Return the messages stamped not later than tick - lag that have not been taken, oldest first."""
        if self._samples.waits:
            self._wait_for_what_is_due(tick_ns)
        taken = []
        with self._changing:
            while self._queue and self._queue[0].header.stamp.to_nsec() <= tick_ns - self._lag_ns:
                taken.append(self._queue.popleft())
        return taken

    def close(self) -> None:
        """End the subscription."""
        self._subscriber.unregister()

    def _wait_for_what_is_due(self, tick_ns: int) -> None:
        if self._connected_ns is None or not self._subscriber.get_num_connections():
            self._connected_ns = tick_ns
        if tick_ns - self._connected_ns >= SETTLING_NS:
            self._samples.at(tick_ns)

    def _connect(self, topic: str) -> None:
        deadline = time.monotonic() + patience_at_least_s(CONNECT_WITHIN_WALL_S)
        is_published = any(name == topic for name, _ in rospy.get_published_topics())
        while is_published and not self._subscriber.get_num_connections() and time.monotonic() < deadline:
            time.sleep(CONNECT_CHECK_WALL_S)

    def _take_in(self, message: Any) -> None:
        # The queue comes first: a thread that waits for the sample then finds the message.
        with self._changing:
            # After the clock was set back, messages of the earlier time would wait until the clock reaches it again.
            if self._queue and message.header.stamp < self._queue[-1].header.stamp:
                self._queue.clear()
            self._queue.append(message)
        self._samples.add(message.header.stamp.to_nsec(), message)
        self._samples.wait_until_wanted()
