"""The command that computes the distances of a recorded test anew."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import json
import sys

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.replay.replay import CannotReplay, replay
from mtr_operator.replay.replay_text import is_unchanged, replay_document, replay_lines
from mtr_operator.storage.progress_file import FILE_NAME, open_progress
from mtr_operator.storage.recorded.recording import recording_folder

from ..exit_codes import EXIT_CHANGED, EXIT_PASS

_PROFILE = "car profile"


def replay_test(options: argparse.Namespace) -> int:
    """Print what would change; the exit code."""
    path = options.results / FILE_NAME if options.results.is_dir() else options.results
    scenario, parameters, progress = open_progress(path, SCENARIOS)
    # Reads the database of a bus: not needed where no Car is named.
    from mtr_operator.car_link.profile import load_profile
    name = options.car_profile or progress.session.get(_PROFILE)
    if not name:
        raise CannotReplay(f"The test in {path} does not say which car profile it had; name one (--car-profile).")
    found = replay(scenario, parameters, progress, options.recording or recording_folder(path), load_profile(name),
                   log=options.can_log)
    for notice in found.notices:
        print(notice, file=sys.stderr)
    if options.json:
        print(json.dumps(replay_document(scenario, found), indent=1, ensure_ascii=False))
    else:
        for line in replay_lines(scenario, found):
            print(line)
    return EXIT_PASS if is_unchanged(found) else EXIT_CHANGED
