"""Sentences about a replay without valid poses: reason first, then the remedy."""
# SPDX-License-Identifier: Apache-2.0
import re

import pytest

from mtr_localization.replay_faults import Topics, faults, is_useless

TOPICS = Topics({"front": "/scan", "rear": "/scan_behind"}, "/odom", "/imu")
GOOD = {"scans": 900, "scans_used": 900, "scans_refused": 0, "refusals": [], "messages": [], "poses": 4500,
        "poses_valid": 4400, "wheel_samples": 4501, "imu_samples": 9001, "duration_s": 90.0}


def test_replay_without_faults_has_no_remark():
    assert faults(GOOD, TOPICS) == [] and not is_useless(GOOD)


def test_few_scans_that_come_late_need_no_remark():
    assert faults({**GOOD, "scans_refused": 5}, TOPICS) == []


def test_refused_scans_come_first_with_lidar_topic_and_reason():
    refusals = [{"lidar": "rear", "message": "Late.", "count": 3},
                {"lidar": "front", "message": "Wrong.", "count": 500}]
    sentences = faults({**GOOD, "scans_refused": 560, "refusals": refusals}, TOPICS)
    assert sentences[:2] == ["500 scans of the front LiDAR (/scan) were refused. Wrong.",
                             "3 scans of the rear LiDAR (/scan_behind) were refused. Late."]
    assert sentences[2].startswith("57 scans came too late") and len(sentences) == 3


@pytest.mark.parametrize(("scans", "words"), [(900, "None of the 900 scans was used"), (0, "no scans on /scan")])
def test_without_a_used_scan_nothing_may_be_relied_on(scans, words):
    summary = {**GOOD, "scans": scans, "scans_used": 0}
    assert words in faults(summary, TOPICS)[0] and is_useless(summary)


@pytest.mark.parametrize(("samples", "limit_s", "words"), [
    (226, 0.2, "gap_limit_s=0.8"), (46, 0.2, "gap_limit_s=1.0"), (226, 0.5, None), (0, 0.2, None)])
def test_slow_odometry_is_named_with_its_parameter(samples, limit_s, words):
    sentences = faults({**GOOD, "wheel_samples": samples}, TOPICS, limit_s)
    assert (words in sentences[0] and "/odom" in sentences[0]) if words else sentences == []


@pytest.mark.parametrize(("valid", "standing", "advised"), [(0, 4500, True), (0, 100, False), (4000, 4500, False)])
def test_bag_that_begins_in_motion_is_advised_its_option(valid, standing, advised):
    messages = [{"code": "localization.stand_still", "message": "Stand still.", "count": standing, "first_s": 0.0}]
    sentences = faults({**GOOD, "poses_valid": valid, "messages": messages}, TOPICS)
    assert any("--in-motion" in sentence for sentence in sentences) is advised
    assert is_useless({**GOOD, "poses_valid": valid}) is (valid == 0)


@pytest.mark.parametrize(("surfels", "code", "is_empty"), [
    (0, "surfel_map.few_surfaces", True), (7, "surfel_map.few_surfaces", False), (0, "surfel_map.not_closed", False)])
def test_map_without_a_surface_makes_each_pose_useless(surfels, code, is_empty):
    summary = {**GOOD, "surfels": surfels, "messages": [{"code": code, "message": "Few.", "count": 1, "first_s": 9.0}]}
    assert is_useless(summary) is is_empty
    assert any("show no surface" in sentence for sentence in faults(summary, TOPICS)) is is_empty


@pytest.mark.parametrize(("change", "first"), [
    ({"imu_samples": 181}, "The IMU on /imu comes every 0.50 s"),
    ({"imu_samples": 451}, "The IMU on /imu comes every 0.20"),
    ({"wheel_samples": 271}, "Odometry on /odom comes every 0.33 s"),
    ({"silent": "localization.imu_silent"}, "Silent. It concerns 4000 of 4500 poses: check .* of /imu, or"),
    ({"silent": "localization.imu_not_a_number"}, "Silent. It concerns 4000"),
    ({"silent": "localization.wheels_silent"}, "Silent. It concerns 4000 of 4500 poses: check .* of /odom.")])
def test_slow_or_silent_input_is_named_first_and_without_false_advice(change, first):
    messages = [{"code": "localization.stand_still", "message": "Stand still.", "count": 4500, "first_s": 0.0}]
    if "silent" in change:
        messages.append({"code": change.pop("silent"), "message": "Silent.", "count": 4000, "first_s": 0.0})
    summary = {**GOOD, "scans_used": 0, "scans_refused": 900, "poses_valid": 0, "messages": messages, **change}
    sentences = faults(summary, TOPICS)
    assert re.match(first, sentences[0]) and sentences[-1].startswith("None of the 900 scans") and len(sentences) == 2
    assert not any(advice in " ".join(sentences) for advice in ("--scan-delay", "--in-motion"))


def test_input_that_was_found_faulty_before_is_named_first_and_once():
    messages = [{"code": "localization.imu_silent", "message": "Silent.", "count": 4000, "first_s": 0.0}]
    assert faults({**GOOD, "messages": messages, "scans_refused": 800}, TOPICS, known=["It ends."]) == ["It ends."]


def test_turn_of_the_wheels_is_no_slow_imu_and_a_short_silence_needs_no_remark():
    assert faults({**GOOD, "imu_samples": 100}, Topics({"front": "/scan"}, "/odom")) == []
    messages = [{"code": "localization.imu_silent", "message": "Silent.", "count": 100, "first_s": 0.0}]
    assert faults({**GOOD, "messages": messages}, TOPICS) == []
