"""Who is let in, and whose Commands count: the list of keys, roles and rates. No sockets inside."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, Dict, NamedTuple, Set

from mtr_core.problems import NO_PROBLEM, Problem

from .. import problems
from .authorised_keys import AuthorisedKeys, Role
from .rates import Rates

# Of one key: the window and the command line make two connections a second at most, while they look for the robot.
CONNECTIONS_PER_S = 4.0
MAX_CONNECTION_BURST = 20.0
# A Command that is sent again and again in the rhythm of Status needs some 20 a second.
MIN_COMMAND_BURST = 50.0


class Sender(NamedTuple):
    """Who has sent a message.

    key: public, Z85, by which senders are told apart. name: the key's owner, for texts; it may change. Both are empty
    on a link without keys. refusal: why the message counts for nothing.
    """

    key: str = ""
    name: str = ""
    refusal: Problem = NO_PROBLEM


ANYBODY = Sender()


class Gate:
    """Asked by ZeroMQ's thread at each connection, and by the node at each message.

    Attributes:
        refused: connections that were refused since the start, by what was wrong.
    """

    def __init__(self, keys: Callable[[], AuthorisedKeys], commands_per_s: float, steady_s: Callable[[], float],
                 distrust: Callable[[], str] = lambda: ""):
        """distrust: why nobody is accepted although there is a list; empty when all is well."""
        self._keys, self._steady_s, self._distrust = keys, steady_s, distrust
        self._connections = Rates(CONNECTIONS_PER_S, MAX_CONNECTION_BURST)
        self._commands = Rates(commands_per_s, max(commands_per_s, MIN_COMMAND_BURST))
        self._known: Set[str] = {entry.key for entry in keys().entries}
        self.refused: Dict[str, int] = {}

    def admits(self, key: str) -> bool:
        """True for a paired key that does not connect too often."""
        if self._keys().of(key) is None:
            self.count("unknown key")
            return False
        if not self._connections.allow(key, self._steady_s()):
            self.count("too many connections")
            return False
        return True

    def count(self, what: str) -> None:
        """Count a connection that was refused."""
        self.refused[what] = self.refused.get(what, 0) + 1

    def sender(self, key: str, now_s: float) -> Sender:
        """Whose message came with this key, and whether it counts, at a time of the steady clock."""
        entry = self._keys().of(key)
        if entry is None:
            return Sender(key, refusal=problems.KEY_UNKNOWN())
        if not self._commands.allow(key, now_s):
            return Sender(key, entry.name, problems.TOO_MANY_COMMANDS(name=entry.name))
        if entry.role is not Role.CONTROLLER:
            return Sender(key, entry.name, problems.VIEWER_COMMAND(name=entry.name))
        return Sender(key, entry.name)

    def has_lost_keys(self) -> bool:
        """True once after a key is accepted no more: its connections are to be cut off."""
        known = {entry.key for entry in self._keys().entries}
        lost = bool(self._known - known)
        self._known = known
        return lost

    def why_lost(self) -> str:
        """A sentence for the log about keys that are accepted no more."""
        return self._distrust() or "A key was revoked."
