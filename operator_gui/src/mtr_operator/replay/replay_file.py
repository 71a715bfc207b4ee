"""Recomputes a test from its progress file, with its own or another car profile."""
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
    """Return the test's scenario and the replay; OperatorError names missing data.

    profile_name: empty for the test's own: as archived in a bundle, else the current one. folder: of the recording,
    None for the folder next to the file. log: see replay.
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
    """Return the profile's path; a relative path is also searched from the test's folder upwards."""
    if not name.endswith(".yaml") or pathlib.Path(name).is_absolute() or pathlib.Path(name).is_file():
        return name
    found = next((folder / name for folder in path.resolve().parents if (folder / name).is_file()), None)
    if found is None:
        raise CannotReplay(f"The test names its car profile as {name}, which is neither in this folder nor above the "
                           "test's; name its file (--car-profile).")
    return str(found)
