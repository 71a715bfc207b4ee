"""Tests of a campaign into the store of results, as they come."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from mtr_operator.storage.progress_file import FILE_NAME
from mtr_results.store.intake import REFUSED, SPOOLED
from mtr_results.store.place import Place

from .folder import OK, CampaignFolder, Done


class Keeping:
    """Puts each test that is done into a store; again changes nothing.

    Attributes:
        sentences: of tests that the store did not take.
    """

    def __init__(self, address: str, folder: CampaignFolder, campaign: str):
        self.sentences: list[str] = []
        self._door = Place(address, spool=folder.path / "spool").door()
        self._folder = folder
        self._campaign = campaign

    def take(self, done: Done) -> None:
        """One run."""
        if done.status != OK:
            return
        intake = self._door.take(self._file_of(done.digest), self._campaign)
        if intake.outcome in (REFUSED, SPOOLED):
            self.sentences.append(intake.sentence)

    def _file_of(self, digest: str) -> pathlib.Path:
        found = sorted(self._folder.of_run(digest).rglob(FILE_NAME))
        return found[0] if found else self._folder.of_run(digest) / FILE_NAME
