"""Requirements of a test on a real robot: a present person in charge, or a rated stop, and confirmed conditions."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ..clocks.simulated_time import is_simulated_robot
from ..errors import OperatorAbsent
from ..identity.identity import Identity
from ..results.session_record import CONDITIONS_CONFIRMED, SUPERVISION
from ..robot_status import RobotStatus
from .conditions import unconfirmed
from .presence import Presence

_NOBODY = ("No test begins on a real robot without a person: nobody can be asked here, and the configuration declares "
           "no unattended_stop (laboratory.yaml), the name of a rated stop.")
_NO_NAME = ("No test begins on a real robot without a person in charge: name one under Car, key and operator, or as "
            "person_in_charge of the identity file.")


@dataclass(frozen=True)
class Supervision:
    """Supervision of one run.

    presence: prompts a person, None if impossible. unattended_stop: name of the rated stop that permits a test without
    a person, empty without one. confirmed: operating conditions that a person has confirmed.
    """

    presence: Presence | None = None
    unattended_stop: str = ""
    confirmed: tuple[str, ...] = ()

    @property
    def is_unattended(self) -> bool:
        """True if a rated stop replaces a person."""
        return bool(self.unattended_stop.strip())

    def missing(self, identity: Identity | None) -> str:
        """Return a sentence why no test starts on a real robot; empty if it may."""
        if self.presence is None and not self.is_unattended:
            return _NOBODY
        if identity is None or not identity.person_in_charge:
            return _NO_NAME
        left = [] if self.is_unattended else unconfirmed(self.confirmed)
        if left:
            return f"No test begins on a real robot before its operating conditions are confirmed: {', '.join(left)}."
        return ""

    def look(self, status: RobotStatus) -> None:
        """Raise OperatorAbsent if the person of a real robot does not answer."""
        if self.presence is None or self.is_unattended or is_simulated_robot(status):
            return
        said = self.presence.look()
        if said:
            raise OperatorAbsent(said)

    def record(self) -> dict[str, str]:
        """Return the entries for the record of a test on a real robot."""
        if self.is_unattended or self.presence is None:
            return {SUPERVISION: f"unattended, stop: {self.unattended_stop.strip()}"}
        return {SUPERVISION: self.presence.text, CONDITIONS_CONFIRMED: ", ".join(self.confirmed)}
