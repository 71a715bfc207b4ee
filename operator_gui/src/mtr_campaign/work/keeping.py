"""Import of the tests of a campaign into the results store, as they finish."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from mtr_operator.storage.progress_file import FILE_NAME
from mtr_results.store.intake import REFUSED, SPOOLED
from mtr_results.store.place import Place

from .folder import OK, CampaignFolder, Done


class Keeping:
    """Imports each finished test into a store; repetitions have no effect.

    Attributes:
        sentences: of tests that the store rejected or that wait in the spool.
    """

    def __init__(self, address: str, folder: CampaignFolder, campaign: str):
        self.sentences: list[str] = []
        self._door = Place(address, spool=folder.path / "spool").door()
        self._folder = folder
        self._campaign = campaign

    def take(self, done: Done) -> None:
        """Import one run."""
        if done.status != OK:
            return
        intake = self._door.take(self._file_of(done.digest), self._campaign)
        if intake.outcome in (REFUSED, SPOOLED):
            self.sentences.append(intake.sentence)

    def _file_of(self, digest: str) -> pathlib.Path:
        found = sorted(self._folder.of_run(digest).rglob(FILE_NAME))
        return found[0] if found else self._folder.of_run(digest) / FILE_NAME
