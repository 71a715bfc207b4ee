"""Questions and sentences in dialogs of their own; none keeps the Operator from the window, and so from its Stop.

Each waits in an event loop of its own for its answer. The system's file dialogs are not used: they are modal on some
systems, and know nothing of the keys that stop the robot.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Callable

from PyQt5.QtCore import QEventLoop, QObject, QTimer
from PyQt5.QtWidgets import QDialog, QFileDialog, QMessageBox, QWidget


def after_delivery(receiver: QObject, ask: Callable[[], None]) -> None:
    """Open a dialog when the events at hand are delivered, for the later ones would pass the earlier ones; not if the
    receiver is no more by then: windows are made anew in another language."""
    timer = QTimer(receiver)
    timer.setSingleShot(True)
    timer.timeout.connect(ask)
    timer.timeout.connect(timer.deleteLater)
    timer.start(0)


def ask_folder(parent: QWidget, title: str, start: pathlib.Path) -> pathlib.Path | None:
    """A folder that the Operator chooses; None when he does not."""
    dialog = QFileDialog(parent, title, str(start))
    dialog.setFileMode(QFileDialog.FileMode.Directory)
    dialog.setOption(QFileDialog.Option.ShowDirsOnly)
    return _chosen(dialog)


def ask_progress_file(parent: QWidget, title: str, start: pathlib.Path) -> pathlib.Path | None:
    """A progress file, or a journal, that the Operator chooses; None when he does not."""
    return _chosen_file(parent, title, start, "JSON (*.json *.journal)")


def ask_yaml_file(parent: QWidget, title: str, start: pathlib.Path) -> pathlib.Path | None:
    """A file of limits or of a calibration record that the Operator chooses; None when he does not."""
    return _chosen_file(parent, title, start, "YAML (*.yaml *.yml)")


def ask_database(parent: QWidget, title: str, start: pathlib.Path) -> pathlib.Path | None:
    """A CAN database that the Operator chooses; None when he does not."""
    return _chosen_file(parent, title, start, "CAN (*.dbc *.arxml *.kcd *.sym)")


def ask_bundle(parent: QWidget, title: str, start: pathlib.Path) -> pathlib.Path | None:
    """A bundle of evidence that the Operator chooses; None when he does not."""
    return _chosen_file(parent, title, start, "MTR (*.mtr.zip)")


def ask_files(parent: QWidget, title: str, start: pathlib.Path, patterns: str) -> list[pathlib.Path]:
    """Files that the Operator chooses, of names that fit patterns such as "*.jpg *.png"; none when he does not."""
    dialog = QFileDialog(parent, title, str(start), f"({patterns})")
    dialog.setFileMode(QFileDialog.FileMode.ExistingFiles)
    dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
    return list(map(pathlib.Path, dialog.selectedFiles())) if _run(dialog) == QDialog.DialogCode.Accepted else []


def show_message(parent: QWidget, title: str, sentence: str) -> None:
    """Show a sentence until the Operator has read it."""
    _run(QMessageBox(QMessageBox.Icon.Warning, title, sentence, QMessageBox.StandardButton.Ok, parent))


def confirm(parent: QWidget, title: str, question: str, answers: tuple[str, str]) -> bool:
    """True when the Operator chooses the first answer; the second one is the safe one."""
    box = QMessageBox(QMessageBox.Icon.Question, title, question, QMessageBox.StandardButton.NoButton, parent)
    yes = box.addButton(answers[0], QMessageBox.ButtonRole.AcceptRole)
    no = box.addButton(answers[1], QMessageBox.ButtonRole.RejectRole)
    box.setDefaultButton(no)
    box.setEscapeButton(no)
    _run(box)
    return box.clickedButton() is yes


def _chosen_file(parent: QWidget, title: str, start: pathlib.Path, kinds: str) -> pathlib.Path | None:
    dialog = QFileDialog(parent, title, str(start), kinds)
    dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
    return _chosen(dialog)


def _chosen(dialog: QFileDialog) -> pathlib.Path | None:
    dialog.setOption(QFileDialog.Option.DontUseNativeDialog)
    return pathlib.Path(dialog.selectedFiles()[0]) if _run(dialog) == QDialog.DialogCode.Accepted else None


def _run(dialog: QDialog) -> int:
    """Show it, and wait for its end; unlike exec_() this leaves all other windows alive."""
    loop = QEventLoop()
    dialog.finished.connect(loop.quit)
    # It goes with its window.
    dialog.destroyed.connect(loop.quit)
    dialog.setModal(False)
    dialog.show()
    loop.exec_()
    return dialog.result()
