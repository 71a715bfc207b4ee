"""Numbers for the orders of applications, which the other nodes tell apart by nothing else."""
# SPDX-License-Identifier: Apache-2.0

MICROSECONDS_PER_S = 1e6


class OrderNumbers:
    """Numbers orders of one kind so that those of different sessions differ; 0 is no order.

    A number is the time in microseconds of the steady clock at which the order was first seen. So no order of before
    has it, not even one from before a restart of the dispatcher, which the other nodes may still remember.
    """

    def __init__(self) -> None:
        self._number = 0
        self._order = (0, 0)

    def number_of(self, session_id: int, order_id: int, now_s: float) -> int:
        """Number of a session's order."""
        if not order_id:
            return 0
        if (session_id, order_id) != self._order:
            self._number = max(self._number + 1, round(now_s * MICROSECONDS_PER_S))
            self._order = (session_id, order_id)
        return self._number

    def id_of(self, session_id: int, number: int) -> int:
        """The session's own id of the order with this number, 0 when it is not its order."""
        return self._order[1] if number and number == self._number and session_id == self._order[0] else 0
