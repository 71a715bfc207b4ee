"""The Operator leaves the line that is being measured, by mouse and by key."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from PyQt5.QtCore import Qt
from PyQt5.QtTest import QTest

SAID = "The line was skipped by the Operator."


def by_mouse(operator, screen):
    operator.click(screen.skip)


def by_key(operator, screen):
    operator.window.activateWindow()
    operator.wait(operator.window.isActiveWindow)
    QTest.keyClick(operator.window, Qt.Key_K, Qt.ControlModifier)


@pytest.mark.parametrize("skip", [by_mouse, by_key])
def test_line_that_is_skipped_is_kept_as_such_and_the_test_goes_on(operator, skip):
    screen = operator.begin()
    operator.wait(screen.skip.isEnabled)
    number = operator.model.line
    assert str(number) in screen.skip.text()
    skip(operator, screen)
    # Until another line is measured a second click would skip nothing.
    assert not screen.skip.isEnabled()
    operator.finish()
    skipped = [result for result in operator.model.results if result.reason == SAID]
    assert [result.number for result in skipped] == [number]
    assert operator.model.test.progress.skipped == [number]
    assert len(operator.model.results) == operator.model.total
    assert any(entry.text == f"Skip line {number}." for entry in operator.model.events.entries)


def test_nothing_is_skipped_before_a_line_and_after_the_test(operator):
    screen = operator.begin()
    assert screen.skip.isVisible() and (operator.model.line or not screen.skip.isEnabled())
    operator.finish()
    assert operator.model.line == 0
    operator.application.flow.skip_line()
    assert not any(result.reason for result in operator.model.results)


def test_skip_takes_the_focus_from_nobody_who_wants_to_stop(operator):
    screen = operator.begin()
    operator.wait(screen.skip.isEnabled)
    operator.click(screen.skip)
    assert operator.window.focusWidget() is operator.window.header.stop
