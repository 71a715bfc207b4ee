"""Robot and car profile of a run: a test goes on with those with which it was begun, and its record names them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Iterator, NamedTuple, Sequence

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import (
    CAR_PROFILE,
    CAR_PROFILE_FILES,
    CONTINUED,
    ROBOT,
    SOFTWARE,
    SUBSTITUTE,
    is_simulated,
    now,
    software,
    written,
)

# By whether the test was begun with a simulated one.
_OTHER_ROBOT = {
    True: "The test was begun with the simulated robot; continue it with that one, or begin a new test.",
    False: "The test was begun with a real robot, and now it is the simulated one; continue it with a real one, or "
           "begin a new test.",
}
_OTHER_CAR = {
    True: "The test was begun with the simulated Car; continue it with that one, or begin a new test.",
    False: "The test was begun at a real Car, and now it is the simulated one; continue it at the real one, or begin a "
           "new test.",
}


class Means(NamedTuple):
    """As they stand in the record; car_profile: empty without an adapter. profile_files: the content of the profile, as
    digest_text() writes it; empty where it is not known."""

    robot: str
    car_profile: str
    profile_files: str = ""

    def go_on(self, progress: Progress) -> None:
        """Note in the record of a test that it goes on now; ProgressFileError when what is measured so far was measured
        with something else. Real robots may take turns: the record names each."""
        if not progress.has_findings:
            progress.session.update({ROBOT: self.robot, CAR_PROFILE: self.car_profile})
            if self.profile_files:
                progress.session[CAR_PROFILE_FILES] = self.profile_files
            return
        self._compare(progress)
        part = f"{written(now())} after {_lines_text(progress.measured())}: {', '.join(self._used(progress))}"
        progress.session[CONTINUED] = "; ".join(filter(None, (progress.session.get(CONTINUED, ""), part)))
        if not is_simulated(self.robot):
            progress.note_used(ROBOT, self.robot)
        if SOFTWARE in progress.session:
            progress.note_used(SOFTWARE, software())

    def _used(self, progress: Progress) -> Iterator[str]:
        """With what the lines of this part are measured."""
        yield software()
        before = progress.session.get(ROBOT, "")
        is_other = before and not is_simulated(self.robot) and self.robot not in before.split(", ")
        yield f"{'another robot, ' if is_other else 'robot '}{self.robot}"
        if self.car_profile:
            yield f"car profile {self.car_profile}"
        if self.profile_files:
            yield self.profile_files
        if progress.calibration is not None:
            yield f"calibration record of {progress.calibration.robot}, {progress.calibration.made.isoformat()}"

    def _compare(self, progress: Progress) -> None:
        """What a record does not say, as one of before there were profiles, cannot differ."""
        robot, profile = progress.session.get(ROBOT, ""), progress.session.get(CAR_PROFILE, "")
        if robot and is_simulated(robot) != is_simulated(self.robot):
            raise ProgressFileError(_OTHER_ROBOT[is_simulated(robot)])
        if not (profile and self.car_profile):
            return
        files = progress.session.get(CAR_PROFILE_FILES, "")
        is_known = bool(files and self.profile_files)
        if files == self.profile_files if is_known else _is_same_profile(profile, self.car_profile):
            return
        if SUBSTITUTE in (profile, self.car_profile):
            raise ProgressFileError(_OTHER_CAR[profile == SUBSTITUTE])
        if _is_same_profile(profile, self.car_profile):
            changed = sorted({each.rpartition(" ")[0] for each in
                              set(files.split(", ")) ^ set(self.profile_files.split(", "))})
            raise ProgressFileError(f"The car profile {profile} has changed since the test was begun: "
                                    f"{', '.join(changed)}; restore it, or begin a new test.")
        raise ProgressFileError(f"The test was begun with the car profile {profile}, and now it is {self.car_profile}; "
                                "continue it with that of before, or begin a new test.")


def _lines_text(numbers: Sequence[int]) -> str:
    """Such as "lines 1 to 3, 5"; consecutive numbers are joined."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    texts = [str(run[0]) if len(run) == 1 else f"{run[0]} to {run[-1]}" for run in runs]
    return f"lines {', '.join(texts)}" if texts else "a part of a line"


def _is_same_profile(one: str, other: str) -> bool:
    """Of names or paths."""
    return one == other or pathlib.Path(one).resolve() == pathlib.Path(other).resolve()
