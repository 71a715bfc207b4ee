"""An axis of Relay resistance played back: the verdict follows what the bus says now."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.domain.actions.distance import Distance
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.replay.points import Point
from mtr_operator.replay.relayed import relayed

LOCKED, UNLOCKED = LineStatus.NOT_REACHED, LineStatus.OK


def point(word, now, distance_m=2.0, doubt=""):
    place = Distance(distance_m, 0.03, 1.0, source="handle")
    return Point(word, LOCKED, place, now, place, doubt)


PROOF = point("relay proof 1", UNLOCKED, 0.6)


def test_request_that_unlocked_by_the_log_makes_the_car_not_resistant():
    columns = relayed([PROOF, point("relay off 1 1", LOCKED), point("relay on 1 1", LOCKED),
                       point("relay on 1 1", UNLOCKED, 3.0)])
    assert (columns["status"], columns["resistance"], columns["distance_m"]) == (UNLOCKED, "not_resistant", 3.0)
    assert (columns["requests_off"], columns["requests_on"], columns["unlocks_on"]) == (1, 1, 1)
    assert columns["cause"] == "handle"


def test_silence_by_the_log_bounds():
    columns = relayed([PROOF, point("relay off 1 1", UNLOCKED), point("relay on 1 1", LOCKED)])
    assert (columns["status"], columns["resistance"], columns["unlocks_off"]) == (LOCKED, "bounded", 1)
    assert (columns["distance_m"], columns["cause"], columns["bound_on"]) == (None, "", pytest.approx(0.95))


@pytest.mark.parametrize(("points", "reason"), [
    ([point("relay proof 1", LOCKED)], "did not unlock inside its zone"),
    ([PROOF, point("relay on 1 1", LineStatus.INVALID, doubt="A switch inside.")], "A switch inside.")])
def test_what_proves_nothing_now_is_invalid(points, reason):
    columns = relayed(points)
    assert (columns["status"], columns["resistance"], columns["distance_m"]) == (LineStatus.INVALID, "", None)
    assert reason in columns["reason"]
