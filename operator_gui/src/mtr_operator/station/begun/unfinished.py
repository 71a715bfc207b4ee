"""The unfinished test, remembered over restarts of the application."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import pathlib

from mtr_operator.domain.errors import OperatorError

from ..settings_file import SettingsStore
from ..test import Test, open_test


class UnfinishedTest:
    """Unfinished test, stored in the settings."""

    def __init__(self, store: SettingsStore):
        self._store = store
        self._dismissed: pathlib.Path | None = None

    @property
    def path(self) -> pathlib.Path | None:
        """Path of its progress file, None if all tests are finished."""
        return self._store.settings.unfinished

    @property
    def offered(self) -> Test | None:
        """Return the test, also of an earlier start; None if no readable one exists, or it was dismissed."""
        path = self.path
        try:
            test = None if path is None or path == self._dismissed else open_test(path)
        except OperatorError:
            return None
        return test if test is not None and test.progress.has_findings else None

    def dismiss(self) -> None:
        """Stop to offer it until the next start, or until it is measured further."""
        self._dismissed = self.path

    def remember(self, path: pathlib.Path) -> None:
        """Remember this test as the current one."""
        self._dismissed = None
        self._keep(path)

    def move(self, test: Test) -> None:
        """Update the path of the remembered test after its files were moved; another remembered test is unchanged."""
        if self.path is not None and self.path.name == test.path.name and test.progress.results:
            self._keep(test.path)

    def forget(self) -> None:
        """Forget the test, because it is finished or has no measurements."""
        self._keep(None)

    def _keep(self, path: pathlib.Path | None) -> None:
        if self.path != path:
            self._store.change(dataclasses.replace(self._store.settings, unfinished=path))
