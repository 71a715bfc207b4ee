"""Commands that list previous tests, and compare two of them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import json
import pathlib
from typing import Sequence

from mtr_operator.domain.results.session_record import STARTED
from mtr_operator.history.entry import TestEntry
from mtr_operator.history.index import Index, cache_path
from mtr_operator.history.line_pairs import Side, open_side
from mtr_operator.history.search import matching, problems_of
from mtr_operator.history.statistics.comparison import compare_sets
from mtr_operator.history.statistics.documents import pair_document
from mtr_operator.history.statistics.texts import comparison_lines
from mtr_operator.station.settings_file import SettingsStore, default_path
from mtr_operator.storage.progress_file import FILE_NAME
from mtr_operator.terminal import show, show_error

_HEADINGS = ("started", "scenario", "lines", "verdict", "car", "key", "file")
_GAP = "  "


def list_history(options: argparse.Namespace) -> None:
    """Print the matching tests, and on stderr a sentence for each unreadable file."""
    folders = options.folder or _usual_folders()
    entries = Index(folders, cache_path(folders)).refresh()
    found = matching(entries, " ".join(options.words), car=options.car, key=options.key, verdict=options.verdict)
    for problem in problems_of(entries):
        show_error(_printable(problem))
    if options.json:
        print(_printable(json.dumps([_document(entry) for entry in found], indent=1, ensure_ascii=False)))
    else:
        for line in _table(found):
            show(_printable(line))


def _printable(text: str) -> str:
    """Return a printable text, because names of files may be invalid text."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def compare_tests(options: argparse.Namespace) -> None:
    """Print the differences of two tests."""
    sides = _side(options.first), _side(options.second)
    comparison = compare_sets(sides[:1], sides[1:])
    if options.json:
        print(json.dumps(pair_document(comparison), indent=1, ensure_ascii=False))
        return
    for number, side in enumerate(sides, start=1):
        show(f"Side {number}: {side.scenario.title} of {side.progress.session.get(STARTED, 'an unknown day')}")
    for line in comparison_lines(comparison):
        show(line)


def _side(path: pathlib.Path) -> Side:
    """Return a test. path: a progress file or journal, or the folder with one."""
    return open_side(path / FILE_NAME if path.is_dir() else path)


def _usual_folders() -> list[pathlib.Path]:
    """Return the folders of the window."""
    store = SettingsStore(default_path())
    store.load()
    return [store.settings.progress_folder, store.settings.result_folder]


def _document(entry: TestEntry) -> dict[str, object]:
    return {name: getattr(entry, name) for name in (
        "path", "started", "scenario", "car", "key", "operator", "place", "done", "total", "invalid", "is_complete",
        "verdict")}


def _table(entries: Sequence[TestEntry]) -> list[str]:
    rows = [_HEADINGS, *((entry.moment, entry.scenario, f"{entry.done}/{entry.total}", entry.verdict or "-",
                          entry.car or "-", entry.key or "-", entry.path) for entry in entries)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(_HEADINGS))]
    return [_GAP.join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]
