"""A test by its progress file, computed anew with the car profile that it names or another one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.results.session_record import CAR_PROFILE, SUBSTITUTE
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.progress_file import open_progress
from mtr_operator.storage.recorded.kept_car import kept_profile
from mtr_operator.storage.recorded.recording import recording_folder

from .cannot import CannotReplay
from .replay import ReplayedTest, replay


def replay_file(path: pathlib.Path, profile_name: str = "", *, folder: pathlib.Path | None = None,
                log: pathlib.Path | None = None) -> tuple[AnyScenario, ReplayedTest]:
    """The test's scenario, and what was found; OperatorError says what is missing.

    profile_name: empty for the one that the test had: as a bundle has kept it, else as it is now. folder: of the
    recording, None for that beside the file. log: see replay.
    """
    if not path.exists():
        raise CannotReplay(f"There is no test in {path}.")
    scenario, parameters, progress = open_progress(path, SCENARIOS)
    name = profile_name or progress.session.get(CAR_PROFILE)
    if name == SUBSTITUTE:
        raise CannotReplay(f"The Car of the test in {path} was the simulated one, which has no bus: there is no log of "
                           "which its distances could be computed anew.")
    if not name:
        raise CannotReplay(f"The test in {path} does not say which car profile it had; name one (--car-profile).")
    recording = folder or recording_folder(path)
    name = profile_name or _found(kept_profile(path, name), path)
    return scenario, replay(scenario, parameters, progress, recording, load_profile(name), log=log)


def _found(name: str, path: pathlib.Path) -> str:
    """The profile as a record names it; a path that was relative is looked for from the test's folder upwards, too."""
    if not name.endswith(".yaml") or pathlib.Path(name).is_absolute() or pathlib.Path(name).is_file():
        return name
    found = next((folder / name for folder in path.resolve().parents if (folder / name).is_file()), None)
    if found is None:
        raise CannotReplay(f"The test names its car profile as {name}, which is neither in this folder nor above the "
                           "test's; name its file (--car-profile).")
    return str(found)
