"""Every point is assigned to its line and attempt."""
# SPDX-License-Identifier: Apache-2.0
import measured
import pytest

from mtr_operator.domain.results.journal import BEGUN, FURTHER, LINE_BEGUN, LINE_RESUMED, POINT
from mtr_operator.storage.journal.journal_file import Entry
from mtr_results.intake.trials import trials_of


def line(number, distance_m):
    return (LINE_BEGUN, {"line": number}), (POINT, measured.point("press 1", distance_m, True))


def filed(*entries, results=()):
    """Return line and attempt of each point."""
    rows = trials_of([Entry(number, *entry) for number, entry in enumerate(entries, start=1)], results)
    return [(row["line"], row["attempt"], row["distance_m"]) for row in rows]


@pytest.mark.parametrize("kind", [FURTHER, LINE_RESUMED])
def test_further_points_belong_to_their_line_and_its_last_attempt(kind):
    (begin_1, point_1), (begin_2, point_2) = line(1, 5.0), line(2, 6.0)
    more = POINT, measured.point("press 2", 5.5, True)
    assert filed(begin_1, point_1, begin_2, point_2, (kind, {"line": 1}), more, begin_1, point_1) == [
        (1, 1, 5.0), (1, 1, 5.5), (1, 2, 5.0), (2, 1, 6.0)]


def test_what_was_measured_before_the_journal_stays_when_a_line_goes_on():
    before, more = measured.searched(1, 5.0), (POINT, measured.point("press 6", 5.05, True))
    begun = BEGUN, {"progress": measured.progress(before).to_document()}
    told = [(1, 1, place_m) for place_m in (*before.worked_at_m, *before.failed_at_m)]
    assert filed(begun, (FURTHER, {"line": 1}), more, results=[before]) == [*told, (1, 1, 5.05)]
    assert filed(begun, (LINE_BEGUN, {"line": 1}), more, results=[before]) == [*told, (1, 2, 5.05)]
