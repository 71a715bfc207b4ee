"""Sentences on a replay without valid poses: the reason first, then what to do."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_localization.replay_faults import Topics, faults, is_useless

TOPICS = Topics({"front": "/scan", "rear": "/scan_behind"}, "/odom")
GOOD = {"scans": 900, "scans_used": 900, "scans_refused": 0, "refusals": [], "messages": [], "poses": 4500,
        "poses_valid": 4400, "wheel_samples": 4501, "duration_s": 90.0}


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
