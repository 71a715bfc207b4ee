"""Admission of peers and of their Commands by the list of keys, roles and rates. No sockets inside."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, Dict, NamedTuple, Set

from mtr_core.problems import NO_PROBLEM, Problem

from .. import problems
from .authorised_keys import AuthorisedKeys, Role
from .rates import Rates

# Limit per key: the window and the command line open at most two connections a second while they search for the robot.
CONNECTIONS_PER_S = 4.0
MAX_CONNECTION_BURST = 20.0
# A Command that is repeated with each Status needs about 20 a second.
MIN_COMMAND_BURST = 50.0


class Sender(NamedTuple):
    """Sender of a message.

    key: public key (Z85), which identifies the sender. name: the key's owner, for texts; it may change. Both are empty
    on a link without keys. refusal: why the message is ignored.
    """

    key: str = ""
    name: str = ""
    refusal: Problem = NO_PROBLEM


ANYBODY = Sender()


class Gate:
    """Gate that ZeroMQ's thread queries at each connection, and the node at each message.

    Attributes:
        refused: number of connections refused since the start, by cause.
    """

    def __init__(self, keys: Callable[[], AuthorisedKeys], commands_per_s: float, steady_s: Callable[[], float],
                 distrust: Callable[[], str] = lambda: ""):
        """distrust: returns why all keys are refused although a list exists, or an empty text."""
        self._keys, self._steady_s, self._distrust = keys, steady_s, distrust
        self._connections = Rates(CONNECTIONS_PER_S, MAX_CONNECTION_BURST)
        self._commands = Rates(commands_per_s, max(commands_per_s, MIN_COMMAND_BURST))
        self._known: Set[str] = {entry.key for entry in keys().entries}
        self.refused: Dict[str, int] = {}

    def admits(self, key: str) -> bool:
        """Return True for a paired key that is within its connection rate."""
        if self._keys().of(key) is None:
            self.count("unknown key")
            return False
        if not self._connections.allow(key, self._steady_s()):
            self.count("too many connections")
            return False
        return True

    def count(self, what: str) -> None:
        """Count a refused connection by its cause."""
        self.refused[what] = self.refused.get(what, 0) + 1

    def sender(self, key: str, now_s: float) -> Sender:
        """Return the sender with this key and whether its message counts, at a time of the steady clock."""
        entry = self._keys().of(key)
        if entry is None:
            return Sender(key, refusal=problems.KEY_UNKNOWN())
        if not self._commands.allow(key, now_s):
            return Sender(key, entry.name, problems.TOO_MANY_COMMANDS(name=entry.name))
        if entry.role is not Role.CONTROLLER:
            return Sender(key, entry.name, problems.VIEWER_COMMAND(name=entry.name))
        return Sender(key, entry.name)

    def has_lost_keys(self) -> bool:
        """Return True once after a key has lost its access, so that its connections can be cut off."""
        known = {entry.key for entry in self._keys().entries}
        lost = bool(self._known - known)
        self._known = known
        return lost

    def why_lost(self) -> str:
        """Return a sentence for the log about the lost keys."""
        return self._distrust() or "A key was revoked."
