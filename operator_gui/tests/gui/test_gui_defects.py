"""A defect is said, what is measured is kept, and the window stays; no abort (C3)."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import subprocess
import sys
import threading

import pytest
from PyQt5.QtCore import QTimer

from mtr_operator.gui.report_writer import ReportWriter
from mtr_operator.station.settings import Settings

PROGRAM = """
import pathlib, sys, threading
from PyQt5.QtCore import QTimer
from mtr_operator.gui.app import Application, make_qt
app = make_qt()
application = Application(pathlib.Path(sys.argv[1]))
application.open()
said = []
application.flow.failed.connect(said.append)
QTimer.singleShot(0, lambda: 1 // 0)
QTimer.singleShot(50, lambda: threading.Thread(target=lambda: [][1]).start())
QTimer.singleShot(600, app.quit)
app.exec_()
application.close()
print(said)
"""


def test_exception_in_a_slot_and_in_a_thread_is_said_and_the_process_goes_on(tmp_path):
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", PROGRAM, str(tmp_path / "settings.json")], capture_output=True,
                          text=True, env=environment, check=False)
    assert done.returncode == 0, done.stderr
    assert "ZeroDivisionError" in done.stdout and "IndexError" in done.stdout
    assert "Traceback" in done.stderr


def test_what_is_measured_is_saved_at_a_defect(operator, qtbot, monkeypatch):
    said = []
    monkeypatch.setattr("mtr_operator.gui.windows.main_window.show_message", lambda *words: said.append(words[-1]))
    screen = operator.begin()
    operator.wait(lambda: operator.model.done >= 1)
    operator.click(operator.window.header.stop)
    operator.wait(screen.resume.isEnabled)
    path = operator.model.test.path
    path.unlink()
    defects = operator.application.defects
    defects.remove()
    with qtbot.capture_exceptions() as caught:
        defects.install()
        QTimer.singleShot(0, lambda: 1 // 0)
        operator.wait(lambda: said and path.exists() and "Saved to" in screen.note.text())
    assert len(caught) == 1
    assert "ZeroDivisionError" in said[0]
    assert json.loads(path.read_text(encoding="utf-8"))["results"]


@pytest.mark.parametrize("spoil", [
    lambda document: document.update(retried=[10 ** 400]), lambda document: document.update(car=[1]),
    lambda document: document["car"].update(length=10 ** 400), lambda document: document.update(scenario=[])])
def test_start_with_a_spoilt_unfinished_test_opens_the_window(operator, start, qtbot, settings_path, spoil):  # C3, N5
    operator.begin()
    operator.finish()
    path = operator.model.test.path
    document = json.loads(path.read_text(encoding="utf-8"))
    spoil(document)
    path.write_text(json.dumps(document), encoding="utf-8")
    store = operator.application.flow.store
    store.change(Settings(**{**store.settings.__dict__, "unfinished": path}))
    later = type(operator)(start(), qtbot, operator.folder).connect()
    assert not later.window.welcome.offer.isVisible()


def test_closing_waits_for_the_files_that_are_being_written(operator, tmp_path, monkeypatch):  # G3
    operator.begin()
    protocol = operator.finish()
    written, go_on = threading.Event(), threading.Event()

    def write(self, kind):
        go_on.wait(10.0)
        written.set()
        return tmp_path / kind
    operator.wait(protocol.save.isEnabled)
    monkeypatch.setattr(ReportWriter, "_write", write)
    operator.click(protocol.save)
    threading.Timer(0.3, go_on.set).start()
    operator.application.close()
    assert written.is_set()
