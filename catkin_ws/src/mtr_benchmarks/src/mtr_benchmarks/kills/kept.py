"""Checks that the stored files of a test lose, duplicate or change nothing between two inspections. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import collections
import math
import pathlib
from typing import Any, Counter, Dict, Sequence

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.journal.journal_file import journal_path, read_journal
from mtr_operator.storage.progress_file import FILE_NAME, load_progress
from mtr_simulation.truth.distance import Comparison

LOST, DOUBLED, CHANGED, WRONG = "lines lost", "lines doubled", "good lines or entries changed", "distances wrong"
UNKEPT, UNREADABLE, UNENDED = ("distances that are no point of the journal", "files that cannot be read",
                               "tests that could not be gone on with")
NOT_BACK, DROVE_ON = "nodes that were not started again", "deaths after which the robot drove on for too long"
MUST = (LOST, DOUBLED, CHANGED, WRONG, UNKEPT, UNREADABLE, UNENDED, NOT_BACK, DROVE_ON)
# Limits of `make bench-truth`: a distance is wrong if its error exceeds both.
MAX_ERROR_M, MAX_SIGMAS = 0.05, 3.0


class Kept:
    """Files of one test.

    Attributes:
        found: number of violations, by the names in MUST.
    """

    def __init__(self, folder: pathlib.Path, scenario: str, parameters: Dict[str, Any]):
        self.path = folder / FILE_NAME
        self.found: Counter[str] = collections.Counter()
        self._scenario: Any = SCENARIOS[scenario]
        self._parameters = self._scenario.parameters_type.from_mapping(parameters)
        self._good: Dict[int, Any] = {}
        self._journal = b""

    @property
    def has_findings(self) -> bool:
        """True if there are results with which a test can continue."""
        journal = journal_path(self.path)
        return self.path.exists() or (journal.exists() and read_journal(journal).holds_findings)

    def look(self) -> None:
        """Compare with the previous inspection."""
        journal = journal_path(self.path)
        content = read_journal(journal).content if journal.exists() else b""
        self.found[CHANGED] += not content.startswith(self._journal)
        self._journal = content if self.has_findings else b""
        progress = self._progress() if self.has_findings else None
        if progress is None:
            return
        numbers = progress.measured()
        self.found[DOUBLED] += len(numbers) - len(set(numbers))
        results = {result.number: result for result in progress.results}
        for number, result in self._good.items():
            self.found[LOST] += number not in results
            self.found[CHANGED] += number in results and results[number] != result
        self._good = {number: result for number, result in results.items() if not result.invalid_count}

    def look_at_end(self) -> None:
        """Check that all lines exist and that each of their distances was measured."""
        self.look()
        progress = self._progress()
        if progress is None:
            return
        wanted = {line.number for line in self._scenario.lines(self._parameters, progress.measured_car)}
        self.found[LOST] += len(wanted - set(progress.measured()))
        points = {round(entry.values["distance"]["distance_m"], 6)
                  for entry in read_journal(journal_path(self.path)).entries
                  if entry.kind == "point" and entry.values["distance"]}
        self.found[UNKEPT] += sum(each.distance_m is not None and each.distance_m not in points
                                  for result in progress.results for each in result.distances)

    def _progress(self) -> Any:
        try:
            return load_progress(self.path, self._scenario, self._parameters.to_mapping())
        except ProgressFileError:
            self.found[UNREADABLE] += 1
            return None


def wrong_distances(lines: Sequence[Comparison]) -> int:
    """Return the number of ok distances that are wrong or have no true event."""
    return sum(_is_wrong(each) for each in lines if each.measured.status == "ok")


def _is_wrong(line: Comparison) -> bool:
    sigma_m = line.measured.uncertainty_m or 0.0
    return not math.isfinite(line.error_m) or abs(line.error_m) > max(MAX_ERROR_M, MAX_SIGMAS * sigma_m)
