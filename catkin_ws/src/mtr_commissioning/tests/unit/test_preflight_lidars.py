"""Each supported kind of LiDAR with the figures of its data sheet: nodes start with it, drive control is never blind,
and preflight accepts it, and rejects it if it is slower."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
import re
from types import SimpleNamespace

import mtr_drive_control_core as core
import pytest
import roslaunch

from mtr_car_locator.parameters import LocatorParameters
from mtr_commissioning.preflight.expected import Setup
from mtr_commissioning.preflight.records import RobotRecord, ScanContent, TopicRecord
from mtr_commissioning.preflight.topics import topic_findings
from mtr_core import names
from mtr_core.parameters import parameters_from
from mtr_core.schedule import DRIVE_CONTROL
from mtr_description.shipped import shipped_urdf

TOP = pathlib.Path(__file__).resolve().parents[5]
PACKAGES = TOP / "catkin_ws" / "src"
KINDS = sorted(path.stem for path in (PACKAGES / "mtr_description" / "config" / "lidars").glob("*.yaml"))
# A chosen time from the last beam to the nodes: some ms in the LiDAR, and the delay of a busy machine.
ON_THE_WAY_S = 0.015
FIELD_OF_VIEW = 0.75  # of a turn, as all of them have


def launched(kind):
    """Return the parameters of robot.launch with LiDARs of a kind, by their names."""
    path = str(TOP / "launch" / "launch" / "robot.launch")
    config = roslaunch.config.load_config_default([(path, [f"lidar:={kind}"])], None, verbose=False)
    return {name: parameter.value for name, parameter in config.params.items()}


def own(parameters, node):
    """Return the parameters of one node."""
    return {name[len(node) + 1:]: value for name, value in parameters.items() if name.startswith(f"{node}/")}


@pytest.fixture(scope="module", params=KINDS)
def lidar(request):
    """Return turns per second, and time between beams."""
    parameters = launched(request.param)
    return SimpleNamespace(rate_hz=parameters[names.LIDAR_TURN_RATE],
                           increment_s=parameters["/localization/time_increment_s"])


def beams(lidar):
    """Return the number of beams of a sweep."""
    return round(FIELD_OF_VIEW / lidar.rate_hz / lidar.increment_s) + 1


def after_s(lidar):
    """Return the time from a sweep's first beam to its arrival."""
    return (beams(lidar) - 1) * lidar.increment_s + ON_THE_WAY_S


@pytest.mark.parametrize("kind", KINDS)
def test_nodes_know_every_parameter_that_a_named_lidar_gives_them(kind):
    parameters = launched(kind)
    assert parameters_from(own(parameters, "/car_locator"), LocatorParameters).time_increment_s > 0.0
    sources = [*(PACKAGES / "mtr_localization" / "src").rglob("*.hpp"),
               *(PACKAGES / "mtr_surfel_map" / "include").rglob("*.hpp"),
               PACKAGES / "mtr_localization" / "src" / "ros" / "node.cpp"]
    known = set(re.findall(r'"(\w+)"', "".join(path.read_text(encoding="utf-8") for path in sources)))
    assert set(own(parameters, "/localization")) <= known


def driver_parameters(*arguments):
    """Return the parameters of the driver of a front LiDAR."""
    given = ["side:=front", "host:=10.0.0.2", "frame:=front_lidar", *arguments]
    path = str(TOP / "launch" / "launch" / "lidar_driver.launch")
    params = roslaunch.config.load_config_default([(path, given)], None, verbose=False).params
    return {name.rpartition("/")[2]: parameter.value for name, parameter in params.items()}


@pytest.mark.parametrize("driver, stated", [("lms1xx", False), ("urg_node", None), ("sick_tim", None)])
def test_no_driver_is_asked_to_report_a_missing_echo_as_free_space(driver, stated):
    assert driver_parameters(f"driver:={driver}").get("publish_min_range_as_inf") is stated


@pytest.mark.parametrize("model, range_m, increment_s", [
    ("", 10.0, None), ("tim551", 10.0, 1.0 / 360.0 / 15.0), ("tim561", 10.0, 1.0 / 1080.0 / 15.0),
    ("tim571", 25.0, 1.0 / 1080.0 / 15.0)])
def test_tim_has_the_range_and_the_times_of_its_model(model, range_m, increment_s):
    found = driver_parameters("driver:=sick_tim", f"model:={model}")
    assert found["range_max"] == range_m
    assert found.get("time_increment") == (increment_s and pytest.approx(increment_s, rel=1e-3))


def test_model_that_nobody_knows_is_refused():
    with pytest.raises(roslaunch.RLException):
        driver_parameters("driver:=sick_tim", "model:=tim999")


@pytest.mark.parametrize("driver", ["lms1xx", "urg_node"])
def test_other_drivers_have_no_parameters_of_a_tim(driver):
    assert not {"range_max", "time_increment"} & set(driver_parameters(f"driver:={driver}"))


def record(lidar, share=1.0, lost=()):
    """Return five seconds of a LiDAR with this share of its turns; sweeps with these numbers are lost."""
    period_s = 1.0 / (share * lidar.rate_hz)
    times = [number * period_s for number in range(int(5.0 / period_s)) if number not in lost]
    content = ScanContent(beams(lidar), 500, 0, (beams(lidar) - 1) * lidar.increment_s)
    heard = TopicRecord("sensor_msgs/LaserScan", ("/driver",), times, [after_s(lidar)] * len(times),
                        scans=[content] * len(times))
    return RobotRecord({names.FRONT_SCAN: heard}, listened_s=5.0)


def bad_checks(lidar, **changes):
    """Return the bad checks of the front LiDAR."""
    setup = Setup(rear_lidar=False, turn_rate_hz=lidar.rate_hz)
    return [finding.check for finding in topic_findings(record(lidar, **changes), setup)
            if finding.is_bad and finding.subject == names.FRONT_SCAN]


def test_lidar_that_keeps_its_data_sheet_is_right_and_one_at_seven_tenths_of_it_is_slow(lidar):
    assert bad_checks(lidar) == []
    assert bad_checks(lidar, share=0.7) == ["topic.rate"]


def test_lidar_whose_sweeps_get_lost_until_drive_control_brakes_is_told(lidar):
    # Number of lost sweeps after which the newest one is too old.
    lost = math.ceil((0.14 - after_s(lidar)) * lidar.rate_hz)
    assert bad_checks(lidar, lost=range(10, 10 + lost)) == ["topic.gap"]


def test_limit_of_the_newest_sweeps_age_is_that_of_drive_control():
    assert Setup().lidar_timeout_s == core.default_collision()["lidar_timeout_s"]


def test_reaction_time_is_that_of_drive_control():
    assert Setup().reaction_s == core.default_collision()["reaction_s"]


def sweep(lidar, number):
    """Return a sweep with objects all around, 5 m away; no two sweeps are equal."""
    count = beams(lidar)
    return SimpleNamespace(
        stamp_ns=round(1e9 * (1.0 + number / lidar.rate_hz)), angle_min_rad=-math.pi * FIELD_OF_VIEW,
        angle_increment_rad=2.0 * math.pi * FIELD_OF_VIEW / (count - 1), time_increment_s=lidar.increment_s,
        range_min_m=0.1, range_max_m=30.0, ranges_m=[5.0 + 0.001 * (number % 7)] * count)


def test_drive_control_is_never_blind_with_a_lidar_that_keeps_its_data_sheet(lidar):
    control, said, turn_radps, heading_rad = core.DriveControl(shipped_urdf()), set(), 0.0, 0.0
    # From the arrival of the first sweep on, at each tick.
    for tick in range(100):
        now_ns = round(1e9 * (1.0 + after_s(lidar))) + tick * DRIVE_CONTROL.period_ns
        newest = sweep(lidar, int((now_ns * 1e-9 - 1.0 - after_s(lidar) + 1e-6) * lidar.rate_hz))
        odometry = SimpleNamespace(x_m=0.0, y_m=0.0, heading_rad=heading_rad, linear_mps=0.0, angular_radps=turn_radps)
        imu = SimpleNamespace(angular_velocity=(0.0, 0.0, turn_radps),
                              acceleration=(0.0, 0.0, 9.81 + 1e-3 * (tick % 7)))
        decision = control.step(now_ns, planner=(0.0, 0.3), front=newest, rear=newest, odometry=odometry, imu=imu)
        turn_radps = decision.angular_radps
        heading_rad += turn_radps * DRIVE_CONTROL.period_ns * 1e-9
        said.add(decision.message)
    assert said == {""} and turn_radps > 0.2
