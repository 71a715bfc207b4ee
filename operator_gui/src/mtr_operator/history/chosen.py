"""Actions on tests that were selected from the history, wherever they are stored."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import TYPE_CHECKING, Callable, Sequence

from mtr_operator.domain.identity.file_name import to_file_name
from mtr_operator.storage.atomic import output_folder
from mtr_operator.storage.inside import inside
from mtr_operator.storage.progress_file import free_path

from .entry import TestEntry
from .laboratory import fetch, file_of
from .line_pairs import Side, open_side
from .statistics.comparison import Comparison, compare_sets

if TYPE_CHECKING:
    from mtr_operator.replay.replay import ReplayedTest

    from .spread import TestSpread

_SECOND = len("2026-11-22T15:36:05")
IsCancelled = Callable[[], bool]


def side_of(entry: TestEntry) -> Side:
    """Open the test; OperatorError states why it cannot be read."""
    with file_of(entry) as path:
        return open_side(path)


def compared(first: TestEntry, second: TestEntry) -> Comparison:
    """Compare both tests; OperatorError if they cannot be read or compared."""
    return compare_sets([side_of(first)], [side_of(second)])


def spread_of_chosen(entries: Sequence[TestEntry], alike: TestEntry | None,
                     is_cancelled: IsCancelled) -> TestSpread | None:
    """Return the spread of these tests, oldest first; None for a single one. alike: omit tests whose parameters differ
    from this one."""
    # Its solvers are not needed for anything else in a window.
    from .spread import spread_of
    sides = [side_of(entry) for entry in entries if not is_cancelled()]
    if alike is not None:
        wanted = side_of(alike).parameters
        sides = [side for side in sides if side.parameters == wanted]
    return spread_of(sides) if len(sides) > 1 else None


def replayed(entry: TestEntry) -> ReplayedTest:
    """Recompute the test."""
    # The import reads logs and databases of buses, which nothing else in a window needs.
    from mtr_operator.replay.replay_file import replay_file
    with file_of(entry) as path:
        return replay_file(path)[1]


def brought(entry: TestEntry, folder: pathlib.Path) -> pathlib.Path:
    """Return the file of a test that can be resumed on this computer; a test of the store is copied to the folder."""
    if not entry.store:
        return entry.file
    moment = entry.started[:_SECOND].replace("T", "_").replace(":", "-")
    name = to_file_name(f"{entry.scenario}_{moment}", "test")
    with output_folder(folder):
        path = free_path(inside(folder, f"{name}.json"))
        fetch(entry, path)
    return path
