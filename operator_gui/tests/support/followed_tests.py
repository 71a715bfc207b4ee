"""Tests that are just being measured, written as the application writes them, and the pages that follow them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import measured

from mtr_operator.domain.results.course import Course
from mtr_operator.domain.results.journal import DECISION, LINE, LINE_BEGUN, POINT
from mtr_operator.domain.results.notebook import Notebook
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.storage.progress_file import FILE_NAME
from mtr_operator.storage.recorded.course_file import CourseFile
from mtr_operator.storage.recorded.recording import recording_folder
from mtr_operator.storage.store import Store
from mtr_results.live.followed import Followed
from mtr_results.live.watch import Watch
from mtr_results.web.live_pages import LivePages


def following(database, *folders):
    """Pages of tests in these folders."""
    return LivePages(Watch(Followed(folders), database))


class Measuring:
    """Context of an application that measures radials of Key press by its own journal, lock and course."""

    def __init__(self, folder, mark="live"):
        folder.mkdir(parents=True, exist_ok=True)
        self.path = folder / FILE_NAME
        self._progress = measured.progress(mark=mark)
        self._progress.kept = None
        self._store = Store(self.path, self._progress)
        self._journal = Notebook(self._progress, measured.SCENARIO.result_type, self._store)
        self._course: Course = CourseFile(recording_folder(self.path) / "course_001.jsonl")
        self._statuses = 0

    def __enter__(self):
        self._store.__enter__()
        return self

    def __exit__(self, *reason):
        self._course.close()
        self._store.__exit__(*reason)

    def begin(self, line, robot_s, action="go to the start"):
        """A line."""
        self._journal.add(DECISION, {"action": f"radial {line}: {action}", "robot_time_s": robot_s})
        self._journal.add(LINE_BEGUN, {"line": line})

    def press(self, distance_m, worked, robot_s=9.0):
        """One point."""
        values = measured.point(f"press {distance_m:g}", distance_m, worked)
        values["distance"]["robot_time_s"] = robot_s
        self._journal.add(POINT, values)

    def end(self, line, distance_m):
        """A line has its result, and the progress file is written."""
        self._journal.add(LINE, {"result": measured.searched(line, distance_m).to_document(), "frame": None})
        self._store.save()

    def stand_at(self, x_m, y_m, robot_s):
        """Statuses of one second, which leave the application together."""
        for tenth in range(10):
            self._statuses += 1
            status = RobotStatus(self._statuses, 1, robot_s + tenth / 10, x=x_m, y=y_m, heading=0.0, pose_valid=True,
                                 key_height_m=1.0)
            self._course.status(status, None)
