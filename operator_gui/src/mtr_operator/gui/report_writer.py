"""Writes the files of a protocol in a thread: pictures take longer than the window may be blocked."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import logging
import pathlib
from typing import Sequence

from PyQt5.QtCore import pyqtSignal

from mtr_operator.domain.errors import OperatorError, OutputError
from mtr_operator.report import budget_json, results_csv
from mtr_operator.station.identity_entry import Annotation
from mtr_operator.station.test import Test
from mtr_operator.storage import progress_file
from mtr_operator.storage.atomic import output_folder, write_bytes
from mtr_operator.storage.photos import copy_photos, photo_folder

from .pictures import export
from .pictures.protocol_picture import Protocol
from .pictures.protocol_sheet import ProtocolSheet
from .threads.waited_thread import WaitedThread

CSV, PNG, PDF, SVG, BUNDLE = "csv", "png", "pdf", "svg", "bundle"
_PERCENT = 100.0
_PICTURES = {PNG: export.png, PDF: export.pdf, SVG: export.svg}


class ReportWriter(WaitedThread):
    """Signals: written(paths), refused(text): of the files; not_annotated(text): nothing was written, for the notes or
    photos could not be kept. bundling(percent): how much of the bundle is done. bundled(Bundled): it is written, before
    written. not_bundled(text): the other files are written, and no bundle, or not all of the files."""

    written = pyqtSignal(list)
    refused = pyqtSignal(str)
    not_annotated = pyqtSignal(str)
    bundling = pyqtSignal(int)
    bundled = pyqtSignal(object)
    not_bundled = pyqtSignal(str)

    def __init__(self, protocol: Protocol, test: Test, folder: pathlib.Path, kinds: Sequence[str],
                 annotation: Annotation | None = None):
        """protocol: of the test. annotation: to be kept with it first."""
        super().__init__()
        self._protocol = protocol
        self._test = test
        self._annotation = annotation
        self._folder = folder
        self._kinds = tuple(kinds)

    def run(self) -> None:
        """See QThread."""
        try:
            if self._annotated():
                self._write_all()
        # Qt ends the process when an exception leaves this function.
        except Exception as error:
            logging.exception("The protocol was not written because of a defect of the application.")
            self.refused.emit(f"The application has a defect: {type(error).__name__}: {error}")

    def _annotated(self) -> bool:
        """Keep what is to be added; False when that is not possible."""
        if self._annotation is None:
            return True
        try:
            self._test.annotate(self._annotation)
        except OperatorError as error:
            self.not_annotated.emit(str(error))
            return False
        self._protocol.progress.identity = self._test.progress.identity
        return True

    def _write_all(self) -> None:
        try:
            with output_folder(self._folder):
                self._write_record()
                written = [self._written(kind) for kind in self._kinds if kind != BUNDLE]
        except OutputError as error:
            self.refused.emit(str(error))
            return
        paths = [path for path in written if path is not None]
        try:
            paths += [self._bundle()] if BUNDLE in self._kinds else []
        except OperatorError as error:
            self.not_bundled.emit(str(error))
        self.written.emit(paths)

    def _bundle(self) -> pathlib.Path:
        from .evidence.bundling import bundle
        target, written = bundle(self._protocol, self._test, self._folder, self._tell)
        self.bundled.emit(written)
        return target

    def _tell(self, share: float) -> None:
        if self.isInterruptionRequested():
            raise OutputError("The bundle was given up, for the window closes.")
        self.bundling.emit(int(share * _PERCENT))

    def _written(self, kind: str) -> pathlib.Path | None:
        """None for a file that a defect keeps from being made: the others and the bundle are written."""
        try:
            return self._write(kind)
        except OutputError:
            raise
        except Exception as error:
            logging.exception("The file of the kind %s was not made because of a defect of the application.", kind)
            self.not_bundled.emit(f"The application has a defect: {type(error).__name__}: {error}")
            return None

    def _write_record(self) -> None:
        """A copy of the record, with its photos: it tells whose report the folder holds."""
        progress, copy = self._protocol.progress, self._folder / progress_file.FILE_NAME
        progress_file.save_progress(copy, progress)
        if progress.identity is not None:
            copy_photos(progress.identity.photos, photo_folder(self._test.path), photo_folder(copy))

    def _write(self, kind: str) -> pathlib.Path:
        protocol = self._protocol
        if kind == CSV:
            path = self._folder / results_csv.FILE_NAME
            text = results_csv.results_csv(protocol.scenario, protocol.progress, protocol.assessment)
            write_bytes(path, text.encode("utf-8"))
            budgets = budget_json.budget_json(protocol.progress, protocol.assessment)
            write_bytes(self._folder / budget_json.FILE_NAME, budgets.encode("utf-8"))
            return path
        path = self._folder / f"protocol.{kind}"
        write_bytes(path, _PICTURES[kind](ProtocolSheet(protocol)))
        return path
