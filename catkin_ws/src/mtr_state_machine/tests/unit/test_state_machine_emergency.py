"""Counting of the messages of emergency stops. A9"""
# SPDX-License-Identifier: Apache-2.0
from mtr_state_machine.emergency import EmergencyWatch
from mtr_state_machine.observation import Emergency


def told(*words):
    watch = EmergencyWatch()
    for owner, engaged in words:
        watch.take(owner, engaged)
    return watch.now()


def test_each_stop_counts_once_however_often_it_is_said():
    assert told() == told(("base", False)) == Emergency()
    assert told(("base", True), ("base", True)) == Emergency(True, 1)
    assert told(("base", True), ("base", False)) == Emergency(False, 1)
    assert told(("base", True), ("base", False), ("base", True)) == Emergency(True, 2)


def test_service_mode_counts_as_a_stop_and_is_told_apart_from_the_others():
    assert told(("service_mode", True)) == Emergency(True, 1, is_service=True)
    assert told(("service_mode", True), ("base", True), ("service_mode", False)) == Emergency(True, 2)
    assert told(("service_mode", False), ("base", False)) == Emergency()


def test_one_of_two_owners_is_enough():
    assert told(("base", True), ("controller_input", True), ("base", False)) == Emergency(True, 2)
    assert told(("base", False), ("controller_input", True), ("base", False)) == Emergency(True, 1)
