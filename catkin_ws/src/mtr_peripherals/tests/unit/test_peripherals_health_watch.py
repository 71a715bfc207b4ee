"""Increasing counters of the firmware yield one sentence, not one per report."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_peripherals.health_watch import QUIET_S, Health, HealthWatch

GOOD = Health()


def watching(first=GOOD):
    watch = HealthWatch()
    assert watch.sentence(first, 0.0) == ""
    return watch


def test_counters_that_stay_say_nothing():
    watch = watching(Health(refused_commands=7, checksum_errors=3, skipped_frames=2))
    assert watch.sentence(Health(refused_commands=7, checksum_errors=3, skipped_frames=2), 100.0) == ""


@pytest.mark.parametrize("changed, words", [
    ({"refused_commands": 2, "last_refusal": 1}, ("2 order", "height")),
    ({"refused_commands": 1, "last_refusal": 99}, ("1 order", "unknown reason")),
    ({"checksum_errors": 4}, ("4 frame", "checksum", "cable")),
    ({"skipped_frames": 5}, ("5 skipped", "cable")),
    ({"resets": 8, "reset_cause": 4}, ("started again", "supply")),
    ({"resets": 8, "reset_cause": 9}, ("power came back", "hung")),
    ({"resets": 8}, ("cause is not known",)),
    ({"resets": 8, "refused_commands": 1}, ("started again", "1 order")),
    ({"calibration_copies": 1}, ("One of two copies",)),
    ({"calibration_copies": 0}, ("not calibrated", "nominal"))])
def test_change_is_said_once(changed, words):
    watch = watching()
    text = watch.sentence(replace(GOOD, **changed), 1.0)
    assert all(word in text for word in words)
    assert watch.sentence(replace(GOOD, **changed), 1.0 + QUIET_S) == ""


def test_what_happens_in_quiet_time_is_added_up():
    watch = watching()
    assert watch.sentence(Health(checksum_errors=1), 1.0)
    assert watch.sentence(Health(checksum_errors=5), 2.0) == ""
    assert "7 frame" in watch.sentence(Health(checksum_errors=8), 1.0 + QUIET_S)


def test_board_that_was_reset_counts_from_zero():
    watch = watching(Health(refused_commands=9))
    assert "1 order" in watch.sentence(Health(refused_commands=1, last_refusal=4), 1.0)


def test_board_without_a_calibration_is_reported_at_its_first_report():
    assert "not calibrated" in HealthWatch().sentence(Health(calibration_copies=0), 0.0)


def test_calibration_lost_after_it_was_repaired_is_said_again():
    watch = HealthWatch()
    assert watch.sentence(Health(calibration_copies=1), 0.0)
    assert watch.sentence(GOOD, 20.0) == ""
    assert watch.sentence(Health(calibration_copies=1), 40.0)


@pytest.mark.parametrize("counter", ["refused_commands", "checksum_errors", "skipped_frames"])
def test_any_counter_that_steps_back_tells_of_a_reset(counter):
    others = {"refused_commands": 5, "checksum_errors": 5, "skipped_frames": 5}
    watch = watching(Health(**{**others, counter: 9}))
    text = watch.sentence(Health(**{**others, counter: 2}), 1.0)
    assert "2 " in text and "5 " in text


def test_reset_in_quiet_time_is_said_after_it():
    watch = watching()
    assert watch.sentence(Health(checksum_errors=1), 100.0)
    assert watch.sentence(Health(resets=1), 101.0) == ""
    text = watch.sentence(Health(resets=1, checksum_errors=2), 100.0 + QUIET_S)
    assert "started again" in text and "2 frame" in text


def test_quiet_time_is_counted_from_the_last_sentence():
    watch = watching()
    assert watch.sentence(Health(checksum_errors=1), 100.0)
    assert watch.sentence(Health(checksum_errors=2), 100.0 + QUIET_S - 0.1) == ""
    assert watch.sentence(Health(checksum_errors=2), 100.0 + QUIET_S)
