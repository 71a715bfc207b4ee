"""Verifies a bundle in a thread, and says what was found."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import logging
import pathlib
from typing import TYPE_CHECKING

from PyQt5.QtCore import pyqtSignal

from ..i18n import translate
from ..sentences import translated
from ..threads.waited_thread import WaitedThread

if TYPE_CHECKING:
    from mtr_operator.evidence.verification import Verification


class BundleCheck(WaitedThread):
    """Signals: checked(path, Verification)."""

    checked = pyqtSignal(object, object)

    def __init__(self, path: pathlib.Path):
        super().__init__()
        self._path = path

    def run(self) -> None:
        """See QThread."""
        # Needs a package of its own, which only bundles need.
        from mtr_operator.evidence.verification import Verification, verify_bundle
        try:
            found = verify_bundle(self._path)
        # Qt ends the process when an exception leaves this function.
        except Exception as error:
            logging.exception("The bundle was not verified because of a defect of the application.")
            found = Verification(problems=(f"The application has a defect: {type(error).__name__}: {error}",))
        self.checked.emit(self._path, found)


def check_text(path: pathlib.Path, found: Verification) -> str:
    """What is intact, by whom and when; or what is not."""
    manifest = found.manifest
    if manifest is None or not found.is_intact:
        problems = " ".join(map(translated, found.problems))
        return translate("BundleCheck", "{name} is not as it was signed: {problems}").format(
            name=path.name, problems=problems)
    return translate("BundleCheck", "{name} is intact: {count} files, bundle {number} of {station}, signed {time} with "
                                    "the key {key}; compare it with the station's.").format(
        name=path.name, count=len(manifest.files), number=manifest.number, station=manifest.station,
        time=manifest.created, key=manifest.key)
