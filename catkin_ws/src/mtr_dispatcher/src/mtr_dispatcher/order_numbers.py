"""Numbers for the orders of applications, by which the other nodes distinguish them."""
# SPDX-License-Identifier: Apache-2.0
import hashlib

_NUMBER_BYTES = 8
_ID_BYTES = 8


class OrderNumbers:
    """Numbers orders of one kind; 0 is not an order.

    A number depends on session and order alone, so orders of different sessions differ. A restarted dispatcher gives
    the present order the same number, so that the other nodes do not repeat a completed order.
    """

    def __init__(self) -> None:
        self._order = (0, 0)

    def number_of(self, session_id: int, order_id: int) -> int:
        """Return the number of a session's order."""
        if not order_id:
            return 0
        self._order = (session_id, order_id)
        return _number(session_id, order_id)

    def id_of(self, session_id: int, number: int) -> int:
        """Return the session's own id of the order with this number, or 0 if it is not its newest order."""
        is_ours = number and session_id == self._order[0] and number == _number(*self._order)
        return self._order[1] if is_ours else 0


def _number(session_id: int, order_id: int) -> int:
    """Return a hash of 63 bits that is never 0."""
    words = session_id.to_bytes(_ID_BYTES, "big") + order_id.to_bytes(_ID_BYTES, "big")
    digest = hashlib.blake2b(words, digest_size=_NUMBER_BYTES).digest()
    return int.from_bytes(digest, "big") >> 1 | 1
