"""The report of a preflight, from the ROS master into the Status."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_core import names
from mtr_dispatcher.command_codec import MAX_MESSAGE_BYTES
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.master_watch import MasterWatch
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.preflight_report import MAX_ITEMS, PreflightItem, parameter_of, report_in, report_of
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.inputs import Inputs
from mtr_dispatcher.status.preflight import MAX_SENTENCE, PREFLIGHT_EVERY
from mtr_proto import robot_link_pb2 as link

FINE = PreflightItem("/imu/data", False, "50.0 Hz.")
FULL = PreflightItem("disk", True, "0.1 GB are free, at least 1 GB is needed: make room.")
REPORT = report_of(90.0, (FINE, FULL, FINE))


def statuses(report, count=PREFLIGHT_EVERY):
    core = Dispatcher(Parameters(), Identity(7, "1.2.3", 0.25, 0.0))
    return [link.Status.FromString(core.status(Inputs(100.0, steady_s=100.0, preflight=report))) for _ in range(count)]


def changed(**parts):
    return {**parameter_of(REPORT), **parts}


def test_report_survives_the_master_and_tells_what_is_wrong_first():
    assert REPORT.items == (FULL, FINE, FINE) and (REPORT.checks, REPORT.bad) == (3, 1)
    assert report_in(parameter_of(REPORT)) == REPORT


@pytest.mark.parametrize("parameter", [
    None, [], "text", 7, {}, changed(made_s="soon"), changed(made_s=math.nan), changed(items=7),
    changed(items=[["one"]]), changed(items=7.0), changed(checks=2), changed(bad=4), changed(checks=-1), changed(bad=0),
    changed(checks=2 ** 40)])
def test_what_anybody_has_set_on_the_master_is_no_report(parameter):
    assert report_in(parameter) is None


def test_bad_findings_are_kept_when_there_are_too_many():
    report = report_of(1.0, (FINE,) * MAX_ITEMS + (FULL,))
    assert len(report.items) == MAX_ITEMS and report.items[0] == FULL
    assert (report.checks, report.bad) == (MAX_ITEMS + 1, 1)


def test_every_tenth_status_has_the_report():
    told = [status.HasField("preflight") for status in statuses(REPORT, 2 * PREFLIGHT_EVERY)]
    assert told == ([False] * (PREFLIGHT_EVERY - 1) + [True]) * 2
    message = statuses(REPORT)[-1].preflight
    assert (message.made_s, message.checks, message.bad) == (90.0, 3, 1)
    assert [(item.name, item.level, item.sentence) for item in message.items[:2]] == [
        ("disk", link.SEVERITY_ERROR, FULL.sentence), ("/imu/data", link.SEVERITY_INFO, FINE.sentence)]


def test_report_that_was_never_made_is_told_as_empty():
    message = statuses(None)[-1]
    assert message.HasField("preflight") and not message.preflight.HasField("made_s") and not message.preflight.items


def test_largest_report_is_within_a_status():
    longest = PreflightItem("n" * 1000, True, "s" * 1000)
    status = statuses(report_of(1.0, (longest,) * 1000))[-1]
    assert len(status.SerializeToString()) <= MAX_MESSAGE_BYTES
    assert len(status.preflight.items) == MAX_ITEMS and len(status.preflight.items[0].sentence) == MAX_SENTENCE


def test_time_of_the_findings_in_motion_is_told_beside_the_report():
    motion = report_of(40.0, (FINE,))
    parameters = {names.PREFLIGHT_REPORT: parameter_of(REPORT), names.PREFLIGHT_MOTION: parameter_of(motion)}
    master = MasterWatch(parameters.get)
    master.update()
    assert master.preflight == REPORT._replace(motion_made_s=40.0)
    assert statuses(master.preflight)[-1].preflight.motion_made_s == 40.0
    # A preflight at rest does not change the findings in motion.
    parameters[names.PREFLIGHT_REPORT] = parameter_of(REPORT._replace(made_s=95.0))
    master.update()
    assert (master.preflight.made_s, master.preflight.motion_made_s) == (95.0, 40.0)
    for damaged in (None, {}, "text", {**parameter_of(motion), "made_s": math.nan}):
        parameters[names.PREFLIGHT_MOTION] = damaged
        master.update()
        assert (master.preflight.made_s, master.preflight.motion_made_s) == (95.0, None)
        assert not statuses(master.preflight)[-1].preflight.HasField("motion_made_s")


def test_report_is_asked_of_the_master_and_gone_with_it():
    parameters = {names.PREFLIGHT_REPORT: parameter_of(REPORT)}
    master = MasterWatch(parameters.get)
    master.update()
    assert master.preflight == REPORT
    parameters.clear()
    master.update()
    assert master.preflight is None
