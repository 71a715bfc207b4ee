"""Opens the application's first window, prints a line when it is painted, and ends."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys
import tempfile

from PyQt5.QtCore import QTimer
from PyQt5.QtWidgets import QApplication

from mtr_operator.gui.app import Application, make_qt


def _tell() -> None:
    print("painted", flush=True)
    QApplication.quit()


def main() -> int:
    """Open and close the application; return the exit status."""
    app = make_qt()
    with tempfile.TemporaryDirectory() as folder:
        application = Application(pathlib.Path(folder) / "settings.json")
        application.open()
        # The timer fires after all events that showing the window has queued.
        QTimer.singleShot(0, _tell)
        app.exec_()
        application.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
