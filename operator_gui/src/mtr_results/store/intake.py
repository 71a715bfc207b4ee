"""Import of test files into the store, or into the spool while the store is unavailable."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from dataclasses import dataclass
from typing import Any, Collection, Iterator

from mtr_operator.domain.errors import OperatorError
from mtr_operator.storage.progress_file import FILE_NAME

from ..errors import StoreAway
from ..intake.record import read_record
from ..intake.source import opened
from .database import Database
from .kept_files import KeptFiles
from .spool import Spool
from .writing import add

SPOOLED, REFUSED = "spooled", "refused"


@dataclass(frozen=True)
class Intake:
    """Result of one test. outcome: of Outcome, or SPOOLED or REFUSED. sentence: reason, empty if the test is stored."""

    path: str
    outcome: str
    sentence: str = ""

    def to_document(self) -> dict[str, Any]:
        """Plain values."""
        return {"path": self.path, "outcome": self.outcome, "sentence": self.sentence}


class Door:
    """Importer of tests. database: None while the store is unavailable, with the reason in why.

    stations: keys of the stations whose bundles are accepted; empty accepts all.
    """

    def __init__(self, database: Database | None, files: KeptFiles | None, spool: Spool, why: str = "",
                 stations: Collection[str] = ()):
        self._database = database
        self._files = files
        self._spool = spool
        self._why = why
        self._stations = stations

    def take_waiting(self) -> Iterator[Intake]:
        """Import the tests that wait for this store; a rejected test remains in the spool."""
        for place in self._spool.unassigned():
            yield Intake(str(place), REFUSED, f"Nobody knows for which store the test in {place} waits; import that "
                                              "folder into its store, and delete it.")
        for place in self._spool.waiting() if self._database is not None else ():
            found = self.take(place / FILE_NAME, self._spool.campaign_of(place))
            if found.outcome not in (REFUSED, SPOOLED):
                self._spool.remove(place)
            yield found
            if found.outcome == SPOOLED:
                return

    def take(self, path: pathlib.Path, campaign: str = "") -> Intake:
        """Import one test; errors become part of the result, so that one bad file does not stop the others."""
        try:
            with opened(path, self._stations) as record_path:
                record = read_record(record_path)
                if self._database is not None:
                    try:
                        return Intake(str(path), add(self._database, self._files, record, campaign).value)
                    except StoreAway as error:
                        self._database, self._why = None, str(error)
                place = self._spool.put(record, record_path, campaign)
        except OperatorError as error:
            return Intake(str(path), REFUSED, str(error))
        said = f"{self._why} The test waits in {place}, and goes in with the next import into this store."
        return Intake(str(path), SPOOLED, said)
