"""The newest message of a topic and its age on the steady clock."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_peripherals.latest import Latest

SECOND = 1_000_000_000


@pytest.mark.parametrize("age_s, found", [(0.0, "word"), (0.2, "word"), (0.21, None), (-0.21, None)])
def test_message_holds_up_to_its_limit_and_not_when_it_is_of_the_future(age_s, found):  # A10
    latest = Latest()
    assert latest.at(SECOND, 0.2) is None
    latest.take("word", SECOND)
    assert latest.at(SECOND + round(age_s * SECOND), 0.2) == found
