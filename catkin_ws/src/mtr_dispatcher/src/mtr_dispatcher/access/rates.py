"""Rate limits per peer: a bounded number of token buckets."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, Hashable, Tuple


class Rates:
    """One bucket per peer, full at first; the peers that were silent longest are dropped.

    rate_per_s: sustained rate of a peer. burst: number of acts allowed at once after a pause.
    """

    def __init__(self, rate_per_s: float, burst: float, max_peers: int = 256):
        self._rate_per_s, self._burst, self._max_peers = rate_per_s, burst, max_peers
        self._buckets: Dict[Hashable, Tuple[float, float]] = {}

    def allow(self, peer: Hashable, now_s: float) -> bool:
        """Count one act of a peer at a time of the steady clock; return False if it exceeds the limit."""
        filled, before_s = self._buckets.pop(peer, (self._burst, now_s))
        filled = min(self._burst, filled + max(now_s - before_s, 0.0) * self._rate_per_s)
        allowed = filled >= 1.0
        self._buckets[peer] = (filled - 1.0 if allowed else filled, now_s)
        while len(self._buckets) > self._max_peers:
            del self._buckets[next(iter(self._buckets))]
        return allowed
