"""Writes the files of a protocol in a thread: pictures take longer than the window may be blocked."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Sequence

from PyQt5.QtCore import QObject, QThread, pyqtSignal

from mtr_operator.domain.errors import OutputError
from mtr_operator.report import results_csv
from mtr_operator.storage import progress_file
from mtr_operator.storage.atomic import output_folder, write_bytes

from .pictures import export
from .pictures.protocol_picture import Protocol
from .pictures.protocol_sheet import ProtocolSheet

CSV, PNG, PDF, SVG = "csv", "png", "pdf", "svg"
_PICTURES = {PNG: export.png, PDF: export.pdf, SVG: export.svg}


class ReportWriter(QThread):
    """Signals: written(paths), refused(text)."""

    written = pyqtSignal(list)
    refused = pyqtSignal(str)

    def __init__(self, protocol: Protocol, folder: pathlib.Path, kinds: Sequence[str], parent: QObject | None = None):
        super().__init__(parent)
        self._protocol = protocol
        self._folder = folder
        self._kinds = tuple(kinds)

    def run(self) -> None:
        """See QThread."""
        try:
            with output_folder(self._folder):
                self.written.emit([self._write(kind) for kind in self._kinds])
        except OutputError as error:
            self.refused.emit(str(error))

    def _write(self, kind: str) -> pathlib.Path:
        protocol = self._protocol
        if kind == CSV:
            path = self._folder / results_csv.FILE_NAME
            write_bytes(path, results_csv.results_csv(protocol.scenario, protocol.progress).encode("utf-8"))
            progress_file.save_progress(self._folder / progress_file.FILE_NAME, protocol.progress)
            return path
        path = self._folder / f"protocol.{kind}"
        write_bytes(path, _PICTURES[kind](ProtocolSheet(protocol)))
        return path
