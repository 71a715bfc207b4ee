"""Command that recomputes the distances of a recorded test."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import json

from mtr_operator.evidence.unpacked import unpacked
from mtr_operator.replay.replay_text import is_unchanged, replay_document, replay_lines
from mtr_operator.storage.progress_file import FILE_NAME
from mtr_operator.terminal import show, show_error

from ..exit_codes import EXIT_CHANGED, EXIT_PASS


def replay_test(options: argparse.Namespace) -> int:
    """Print the changes; return the exit code."""
    # This reads the database of a bus, which is needed only for a replay.
    from mtr_operator.replay.replay_file import replay_file
    with unpacked(options.results) as results:
        path = results / FILE_NAME if results.is_dir() else results
        scenario, found = replay_file(path, options.car_profile or "", folder=options.recording, log=options.can_log)
    for notice in found.notices:
        show_error(notice)
    if options.json:
        print(json.dumps(replay_document(scenario, found), indent=1, ensure_ascii=False))
    else:
        for line in replay_lines(scenario, found):
            show(line)
    return EXIT_PASS if is_unchanged(found) else EXIT_CHANGED
