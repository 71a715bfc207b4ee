"""The test that was begun and not finished, remembered over starts of the application."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import pathlib

from mtr_operator.domain.errors import OperatorError

from ..settings_file import SettingsStore
from ..test import Test, open_test


class UnfinishedTest:
    """Kept in the settings."""

    def __init__(self, store: SettingsStore):
        self._store = store
        self._dismissed: pathlib.Path | None = None

    @property
    def path(self) -> pathlib.Path | None:
        """Its progress file, None when every test was finished."""
        return self._store.settings.unfinished

    @property
    def offered(self) -> Test | None:
        """The test, also of an earlier start; None when there is none that can be read, or none is wanted now."""
        path = self.path
        try:
            test = None if path is None or path == self._dismissed else open_test(path)
        except OperatorError:
            return None
        return test if test is not None and test.progress.has_findings else None

    def dismiss(self) -> None:
        """Offer it no more until the next start, or until it is measured further."""
        self._dismissed = self.path

    def remember(self, path: pathlib.Path) -> None:
        """This test is measured now."""
        self._dismissed = None
        self._keep(path)

    def move(self, test: Test) -> None:
        """What is remembered of a test is written elsewhere now; another one that is remembered stays."""
        if self.path is not None and self.path.name == test.path.name and test.progress.results:
            self._keep(test.path)

    def forget(self) -> None:
        """It is finished, or has measured nothing."""
        self._keep(None)

    def _keep(self, path: pathlib.Path | None) -> None:
        if self.path != path:
            self._store.change(dataclasses.replace(self._store.settings, unfinished=path))
