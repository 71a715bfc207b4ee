"""Questions and sentences in dialogs of their own."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from PyQt5.QtWidgets import QFileDialog, QMessageBox, QWidget


def ask_folder(parent: QWidget, title: str, start: pathlib.Path) -> pathlib.Path | None:
    """A folder that the Operator chooses; None when he does not."""
    chosen = QFileDialog.getExistingDirectory(parent, title, str(start))
    return pathlib.Path(chosen) if chosen else None


def ask_progress_file(parent: QWidget, title: str, start: pathlib.Path) -> pathlib.Path | None:
    """A progress file, or a journal, that the Operator chooses; None when he does not."""
    chosen, _ = QFileDialog.getOpenFileName(parent, title, str(start), "JSON (*.json *.journal)")
    return pathlib.Path(chosen) if chosen else None


def ask_yaml_file(parent: QWidget, title: str, start: pathlib.Path) -> pathlib.Path | None:
    """A file of limits or of a calibration record that the Operator chooses; None when he does not."""
    chosen, _ = QFileDialog.getOpenFileName(parent, title, str(start), "YAML (*.yaml *.yml)")
    return pathlib.Path(chosen) if chosen else None


def show_message(parent: QWidget, title: str, sentence: str) -> None:
    """Show a sentence until the Operator has read it."""
    QMessageBox(QMessageBox.Icon.Warning, title, sentence, QMessageBox.StandardButton.Ok, parent).exec_()


def confirm(parent: QWidget, title: str, question: str, answers: tuple[str, str]) -> bool:
    """True when the Operator chooses the first answer; the second one is the safe one."""
    box = QMessageBox(QMessageBox.Icon.Question, title, question, QMessageBox.StandardButton.NoButton, parent)
    yes = box.addButton(answers[0], QMessageBox.ButtonRole.AcceptRole)
    no = box.addButton(answers[1], QMessageBox.ButtonRole.RejectRole)
    box.setDefaultButton(no)
    box.setEscapeButton(no)
    box.exec_()
    return box.clickedButton() is yes
