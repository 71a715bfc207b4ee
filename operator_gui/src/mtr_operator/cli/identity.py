"""Identity of a test from the command line, and its check against the laboratory's rules."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import dataclasses
import pathlib

from mtr_operator.domain.errors import InvalidIdentity
from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.identity.laboratory import Laboratory
from mtr_operator.domain.results.journal import IDENTITY
from mtr_operator.domain.results.progress import Progress
from mtr_operator.station.settings_file import laboratory_path
from mtr_operator.storage.identity_file import GivenIdentity, load_identity, load_laboratory
from mtr_operator.storage.photos import check_photos, discard_photos, keep_photos, photo_folder
from mtr_operator.storage.store import Store


class RunIdentity:
    """Identity of one test. Its constructor checks the files; InvalidIdentity states a fault."""

    def __init__(self, options: argparse.Namespace):
        self._given = GivenIdentity() if options.identity is None else load_identity(options.identity)
        self._laboratory = Laboratory()
        # A demo has no identity.
        if options.command != "demo":
            self._laboratory = load_laboratory(options.laboratory or laboratory_path())
        check_photos(self._given.photos)

    @property
    def unattended_stop(self) -> str:
        """Rated stop that the laboratory declares for unattended tests; empty without one."""
        return self._laboratory.unattended_stop

    def give(self, progress: Progress) -> None:
        """Assign the identity to a new test; InvalidIdentity if a field that the laboratory requires is missing."""
        identity = self._given.identity.filled_from(self._laboratory.defaults)
        self._laboratory.check(identity, len(self._given.photos))
        progress.identity = None if identity.is_empty and not self._given.photos else identity

    def compare(self, progress: Progress) -> None:
        """Compare with the identity of a resumed test: its results belong to the original car and key."""
        mine, then = self._given.identity, progress.identity or Identity()
        for name in ("car_vin", "key_serial"):
            said, stored = getattr(mine, name), getattr(then, name)
            if said and stored and said != stored:
                raise InvalidIdentity(f"The test was begun with another {name}, {stored}; now it is {said}. Continue "
                                      "it with that one, or begin a new test.")
        if not mine.is_empty:
            progress.identity = mine.filled_from(then)

    def keep(self, store: Store, progress: Progress) -> None:
        """Copy the photos next to the progress file, and store this run's identity; OutputError if that fails."""
        photos = self._given.photos
        if photos:
            kept = keep_photos(photos, photo_folder(store.path))
            progress.identity = dataclasses.replace(progress.identity or Identity(), photos=kept)
        if progress.identity is not None and (photos or not self._given.identity.is_empty):
            store.add(IDENTITY, progress.identity.to_document())

    def discard_photos(self, path: pathlib.Path) -> None:
        """Remove the photos of a test without measurements."""
        if self._given.photos:
            discard_photos(photo_folder(path))
