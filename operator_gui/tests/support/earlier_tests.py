"""An Operator who has measured before, and what he sees of it in the window."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses

import pytest

from mtr_operator.domain.identity.identity import Identity
from mtr_operator.domain.results.progress import JournalMark
from mtr_operator.storage.progress_file import save_progress


@pytest.fixture
def lab(operator):
    """An operator with three tests: one measured now, one of another car, and the half of one."""
    operator.begin("key_press")
    operator.click(operator.finish().done)
    folder = operator.application.flow.store.settings.progress_folder
    [record] = folder.glob("*.json")
    progress = operator.application.flow.open(record) or operator.model.current_test.progress
    operator.application.flow.to_welcome()
    for number, (vin, results) in enumerate((("OTHER", progress.results), ("", progress.results[:2])), start=1):
        session = {**progress.session, "started": f"2020-01-0{number}T10:00:00+01:00"}
        save_progress(folder / f"{number}.json", dataclasses.replace(
            progress, session=session, results=list(results), kept=JournalMark(str(number), 5), frame_record=type(
                progress.frame_record)(), identity=Identity(vin) if vin else None))
    return operator


def shown_history(operator, count=3):
    """The history, when it is read."""
    history = operator.window.history
    operator.click(operator.window.welcome.open)
    operator.wait(lambda: len(history.shown) == count and "tests" in history.notice.text())
    return history


def opened(lab, kind):
    """The window that comes when a thread has done its work."""
    lab.wait(lambda: lab.window.findChildren(kind))
    [window] = lab.window.findChildren(kind)
    return window
