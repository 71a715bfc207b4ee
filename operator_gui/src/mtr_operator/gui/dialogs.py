"""Questions of the system's own dialogs: folders and files."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from PyQt5.QtWidgets import QFileDialog, QWidget


def ask_folder(parent: QWidget, title: str, start: pathlib.Path) -> pathlib.Path | None:
    """A folder that the Operator chooses; None when he does not."""
    chosen = QFileDialog.getExistingDirectory(parent, title, str(start))
    return pathlib.Path(chosen) if chosen else None


def ask_progress_file(parent: QWidget, title: str, start: pathlib.Path) -> pathlib.Path | None:
    """A progress file that the Operator chooses; None when he does not."""
    chosen, _ = QFileDialog.getOpenFileName(parent, title, str(start), "JSON (*.json)")
    return pathlib.Path(chosen) if chosen else None
