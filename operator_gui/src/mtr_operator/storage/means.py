"""Robot and car profile of a run: a test goes on with those with which it was begun, and its record names them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import NamedTuple

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import (
    CAR_PROFILE,
    CONTINUED,
    ROBOT,
    SUBSTITUTE,
    is_simulated,
    now,
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
    """As they stand in the record; car_profile: empty without an adapter."""

    robot: str
    car_profile: str

    def go_on(self, progress: Progress) -> None:
        """Note in the record of a test that it goes on now; ProgressFileError when what is measured so far was measured
        with something else. Real robots may take turns: the record names each."""
        if not progress.has_findings:
            progress.session.update({ROBOT: self.robot, CAR_PROFILE: self.car_profile})
            return
        self._compare(progress)
        progress.session[CONTINUED] = written(now())
        if not is_simulated(self.robot):
            progress.note_used(ROBOT, self.robot)

    def _compare(self, progress: Progress) -> None:
        """What a record does not say, as one of before there were profiles, cannot differ."""
        robot, profile = progress.session.get(ROBOT, ""), progress.session.get(CAR_PROFILE, "")
        if robot and is_simulated(robot) != is_simulated(self.robot):
            raise ProgressFileError(_OTHER_ROBOT[is_simulated(robot)])
        if not (profile and self.car_profile) or _is_same_profile(profile, self.car_profile):
            return
        if SUBSTITUTE in (profile, self.car_profile):
            raise ProgressFileError(_OTHER_CAR[profile == SUBSTITUTE])
        raise ProgressFileError(f"The test was begun with the car profile {profile}, and now it is {self.car_profile}; "
                                "continue it with that of before, or begin a new test.")


def _is_same_profile(one: str, other: str) -> bool:
    """Of names or paths."""
    return one == other or pathlib.Path(one).resolve() == pathlib.Path(other).resolve()
