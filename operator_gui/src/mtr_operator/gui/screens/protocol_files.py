"""Files of a protocol: written in a thread, with notes and photos, into a folder that is asked for where it is gone."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import os
import pathlib
from typing import TYPE_CHECKING, NamedTuple

from PyQt5.QtCore import QObject, Qt, QUrl, pyqtSignal
from PyQt5.QtGui import QDesktopServices
from PyQt5.QtWidgets import QWidget

from mtr_operator.station.identity_entry import Annotation
from mtr_operator.station.test import Test, report_folder

from ..dialogs import after_delivery, ask_folder
from ..flow import Flow
from ..pictures.protocol_picture import ProtocolPicture
from ..report_writer import CSV, PNG, ReportWriter
from ..sentences import translated
from .annotation_dialog import AnnotationDialog

if TYPE_CHECKING:
    from ..evidence.bundling import Bundled

_MAY_BREAK = "\N{ZERO WIDTH SPACE}"


class Shown(NamedTuple):
    """What is shown, and of which test: a question may be answered when another one is at hand."""

    picture: ProtocolPicture
    test: Test


class ProtocolFiles(QObject):
    """Of the test that a screen shows, or of that for which the Operator was asked.

    Signals: saving(is_saving): they are being written, or no longer. written: there is a folder to be shown.
    told(text): what became of them.
    """

    saving = pyqtSignal(bool)
    written = pyqtSignal()
    told = pyqtSignal(str)

    def __init__(self, flow: Flow, screen: QWidget):
        super().__init__(screen)
        self._flow, self._screen = flow, screen
        self._now: Shown | None = None
        self._of: Shown | None = None
        self._writer: ReportWriter | None = None
        self._kinds: tuple[str, ...] = ()
        self._saved: set[str] = set()
        self._said = ""
        self._folder: pathlib.Path | None = None

    @property
    def shown(self) -> Shown:
        """What is shown now; LookupError before the first."""
        if self._now is None:
            raise LookupError("no test is shown yet")
        return self._now

    def show(self, shown: Shown) -> None:
        """Another one is shown, of which nothing has been written yet."""
        self._now, self._folder, self._said = shown, None, ""
        self._saved.clear()

    def write(self, kinds: tuple[str, ...], annotation: Annotation | None = None, of: Shown | None = None) -> None:
        """Write files of what is shown, or of what was shown when the Operator was asked."""
        self._of = of = of or self.shown
        self._folder = report_folder(self._flow.store.settings.result_folder, of.test)
        self.saving.emit(True)
        self._kinds = kinds
        # No child of the screen, and no lambda: it may outlive both when the window closes or is made anew.
        self._writer = ReportWriter(of.picture.protocol, of.test, self._folder, kinds, annotation)
        self._writer.written.connect(self._learn_written)
        self._writer.refused.connect(self._learn_refused)
        self._writer.not_annotated.connect(self._learn_not_annotated)
        self._writer.bundling.connect(self._learn_bundling)
        self._writer.bundled.connect(self._learn_bundled)
        self._writer.not_bundled.connect(self._learn_not_bundled)
        self._said = ""
        self._writer.start()

    def annotate(self) -> None:
        """Ask for notes and photos beside the window, whose Stop stays at hand."""
        shown = self.shown
        dialog = AnnotationDialog(shown.test.progress.identity, self._screen)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        # They are kept in the record, and the files written anew.
        dialog.accepted.connect(lambda: self.write((CSV, PNG), dialog.annotation, shown))
        dialog.show()

    def open_folder(self) -> None:
        """Have the system show the folder."""
        if not QDesktopServices.openUrl(QUrl.fromLocalFile(str(self._folder))):
            sentence = self.tr("No file manager opens it; the files are in {folder}")
            self.told.emit(sentence.format(folder=self._folder))

    def _learn_written(self, paths: list[pathlib.Path]) -> None:
        self.saving.emit(False)
        names = {path.name for path in paths}
        if self._of == self._now:
            self._saved |= names
            names = self._saved
        # A long path goes on in the next line.
        folder = str(self._folder).replace(os.sep, f"{os.sep}{_MAY_BREAK}")
        saved = self.tr("Saved {files} to {folder}").format(files=", ".join(sorted(names)), folder=folder)
        self.told.emit(f"{saved}. {self._said}" if self._said else saved)
        self.written.emit()

    def _learn_bundling(self, percent: int) -> None:
        self.told.emit(self.tr("The bundle is written: {percent} %.").format(percent=percent))

    def _learn_bundled(self, bundled: Bundled) -> None:
        self._said = self.tr("It is bundle {number} of {station}.").format(number=bundled.number,
                                                                          station=bundled.station)
        for name, reason in bundled.left_out.items():
            self._said += " " + self.tr("Left out is {name}: {reason}").format(name=name, reason=translated(reason))

    def _learn_not_bundled(self, text: str) -> None:
        self._said = translated(text)

    def _learn_refused(self, text: str) -> None:
        self.saving.emit(False)
        self.told.emit(translated(text) + " " + self.tr("Choose another folder; nothing is lost."))
        of, kinds = self._of, self._kinds
        after_delivery(self, lambda: self._ask_folder(of, kinds))

    def _learn_not_annotated(self, text: str) -> None:
        self.saving.emit(False)
        self.told.emit(translated(text))

    def _ask_folder(self, of: Shown | None, kinds: tuple[str, ...]) -> None:
        folder = ask_folder(self._screen, self.tr("Folder for results"), pathlib.Path.home())
        if folder is not None:
            store = self._flow.store
            store.change(dataclasses.replace(store.settings, result_folder=folder))
            self.write(kinds, of=of)
