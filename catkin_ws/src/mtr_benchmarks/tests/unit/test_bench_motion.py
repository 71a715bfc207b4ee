"""References of the motion benchmark: lower bounds of durations, and drive control's own limits."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import mtr_drive_control_core
import pytest
from shapely.geometry import Polygon

from mtr_benchmarks.harness.lines import line
from mtr_benchmarks.harness.rows import all_met
from mtr_benchmarks.motion import encounters, grounds, latency, posts, tip_over, tracking, wide_encounters
from mtr_benchmarks.motion.__main__ import PROMISED, report
from mtr_benchmarks.motion.bound import Ends, lower_bound, shortest_way
from mtr_benchmarks.motion.encounter import EncounterEnd, simulate
from mtr_benchmarks.motion.limiter import PERIOD_S, Limiter
from mtr_benchmarks.motion.rig import Rig
from mtr_benchmarks.motion.trial import DrivenLeg
from mtr_core.se2 import Pose2
from mtr_core.states import Result
from mtr_description.shipped import shipped_geometry
from mtr_motion_planner.following.ramp import ANGULAR_SHARE, LINEAR_SHARE
from mtr_motion_planner.geometry.keep_out import KeepOut
from mtr_motion_planner.geometry.robot_outline import RobotOutline
from mtr_motion_planner.parameters import MotionParameters
from mtr_motion_planner.search.options import Target
from mtr_motion_planner.search.planning import Planning
from mtr_motion_planner.timing.plan import Moving
from mtr_simulation.site.scenario import Scenario
from mtr_simulation.site.surroundings import Wall

PARAMETERS = MotionParameters()
OUTLINE = RobotOutline(shipped_geometry().footprint(), PARAMETERS.slip)
CAR = Polygon([(2.25, 0.9), (-2.25, 0.9), (-2.25, -0.9), (2.25, -0.9)])
FAR = Polygon([(90.0, 90.0), (91.0, 90.0), (91.0, 91.0)])
LIMITS = PARAMETERS.limits


def bound(start, end, car=FAR, speed=0.5):
    return lower_bound(Ends(start, end), car, 0.315, LIMITS, speed)


def test_straight_motion_takes_its_bound():
    assert bound(Pose2(0, 0, 0), Pose2(4, 0, 0)) == pytest.approx(4.0 / 0.5 + 0.5 / 0.8 + 0.2, abs=0.1)


@pytest.mark.parametrize("angle", [0.5, 2.0, math.pi])
def test_turn_on_the_spot_takes_its_bound(angle):
    assert bound(Pose2(0, 0, 0), Pose2(0, 0, angle)) == pytest.approx(LIMITS.turn_time(angle))


@pytest.mark.parametrize("car", [CAR, FAR])
@pytest.mark.parametrize("heading", [0.0, 1.2, 2.5, -2.0, 3.1])
@pytest.mark.parametrize("speed", [0.4, 1.0])
def test_no_plan_is_quicker_than_the_bound(car, heading, speed):
    start, end = Pose2(4.0, 1.0, heading), Pose2(-4.0, -1.5, 0.3 - heading)
    keep_out = KeepOut(list(car.exterior.coords)[:-1], OUTLINE, PARAMETERS.margins)
    plan = Planning(keep_out, None, PARAMETERS, speed).plan(Moving(start), Target(end))
    assert plan.duration_s >= bound(start, end, car, speed) - 0.1


def test_shortest_way_goes_around_the_nearer_side():
    way = shortest_way((4.0, 0.5), (-4.0, 0.5), CAR.buffer(0.3))
    assert min(y for _, y in way) >= 0.5


def test_planned_motion_with_what_the_controller_adds_passes_drive_controls_limits():
    allowed = mtr_drive_control_core.limits_at(1.55)
    assert LINEAR_SHARE * LIMITS.acceleration_mps2 <= allowed["linear_acceleration_mps2"]
    assert ANGULAR_SHARE * LIMITS.angular_acceleration_radps2 <= allowed["angular_acceleration_radps2"]
    assert LIMITS.max_angular_radps < allowed["max_angular_radps"]
    assert LIMITS.lateral_acceleration_mps2 < allowed["lateral_acceleration_mps2"]


@pytest.mark.parametrize("curvature", [0.0, 0.2, 0.5, 1.0, 2.0, 4.0])
def test_planned_curve_passes_drive_controls_limits_with_the_key_raised(curvature):
    speed = LIMITS.corner_speed(curvature)
    assert speed * curvature <= mtr_drive_control_core.yaw_rate_at(1.55, speed)


@pytest.mark.parametrize("wanted", [(0.7, 0.3), (0.4, -1.4), (-0.5, 1.0), (0.79, 0.0)])
def test_limiter_reaches_what_is_allowed_and_never_jumps(wanted):
    limiter, before = Limiter(), (0.0, 0.0)
    for _ in range(200):
        sent = limiter.follow(wanted)
        assert abs(sent[0] - before[0]) <= 1.5 * PERIOD_S + 1e-9
        assert abs(sent[0] * sent[1]) <= 1.0 + 1e-9
        before = sent
    assert sent == pytest.approx(wanted, abs=1e-6)


def tracked(**changed):
    """Return figures of pairs that meet all limits."""
    return tracking.TrackingFigures(**{
        "pairs": 200, "time_ratio_median": 9.0, "time_ratio_p95": 1.15, "time_ratio_worst": 1.3,
        "cross_track_p95_m": 0.02, "cross_track_worst_m": 0.03, "heading_p95_deg": 1.0, "heading_worst_deg": 2.0,
        "stop_error_p95_m": 0.02, "stop_error_worst_m": 0.03, "stop_heading_p95_deg": 1.0,
        "stop_heading_worst_deg": 2.0, "contacts_with_car": 0, "min_clearance_m": math.inf, "not_reached": [],
        **changed})


def parts(**changed):
    """Return figures of all parts that meet all limits except for the changes."""
    found = {
        "tracking": tracked(),
        "posts": posts.PostsFigures(0.02, 1.0, {"0.2 m/s, 0.65 m": 0.01}),
        "encounters": encounters.EncounterFigures(
            1000, 0, 0, 1, 900, [], {"arc, rear": "0 of 9"}, 7, 2, 98, 0.1, [], []),
        "wide_encounters": wide_encounters.WideEncounterFigures(
            300, 0, 0, 4, 20, {"wide": 300, "walker": 100, "child": 50, "lying": 20}, {"lying": [0.5]}, {"lying": [7]}),
        "tip_over": tip_over.TipOverFigures(1.0, {"start": 1.0}, [60.0], {}),
        "grounds": grounds.GroundFigures(2.0, 20.0, 0.4, 0.0, 0.5, 0, 3, 1.5, 0, 5.0, 0.0, {}),
        "latency": latency.LatencyFigures(20.0, 3.0, 25.0, 400, 5.0),
    }
    return {name: replace(part, **{key: value for key, value in changed.items() if hasattr(part, key)})
            for name, part in found.items()}


def test_promised_figures_are_numbers_on_top_and_everything_is_below():
    written = report(parts()).document()
    assert list(written) == [*PROMISED, "details", "table"]
    assert written["encounters"] == 1000 and written["details"]["tracking"]["pairs"] == 200
    assert written["details"]["tracking"]["min_clearance_m"] is None, "JSON has no infinity"
    more = (tracking.NOT_REACHED, tracking.CONTACTS, grounds.WAY, grounds.STEEP_WAY, grounds.DEAD_STOP,
            grounds.CONTACTS, grounds.SLIPPERY_STOP, grounds.CABLE_LOAD)
    assert len(written["table"]) == len(PROMISED) + len(more)


def test_parts_that_were_not_run_have_no_rows():
    written = report({"latency": parts()["latency"]}).document()
    assert list(written) == ["stop_latency_p99_ms", "drive_control_cpu_percent", "details", "table"]


@pytest.mark.parametrize("key, value, is_good", [
    ("time_ratio_p95", 1.15, True), ("time_ratio_p95", 1.151, False), ("encounters", 999, False),
    ("contacts_while_moving", 1, False), ("tip_margin_n", 0.0, False), ("stop_latency_p99_ms", math.nan, False),
    ("time_ratio_median", 99.0, True), ("not_reached", ["pair 7: REFUSED There is no way."], False),
    ("wide_movers", 299, False), ("wide_contacts_while_moving", 1, False), ("walker_contacts_while_moving", 1, False),
    ("child_contacts_while_moving", 50, True), ("lying_contacts_while_moving", 0, True),
    ("slope_load_n", 0.9, False), ("climb_load_n", 0.0, False), ("slope_way_m", 0.1, False),
    ("steep_way_m", 0.1, False), ("contacts", 1, False), ("dead_stop_load_n", 0.0, True),
    ("slippery_contacts", 8, True), ("slippery_stop_m", 9.0, True),
    ("cable_stops", 1, False), ("cable_tilt_deg", 8.1, False), ("cable_load_n", 0.0, True),
    ("contacts_with_car", 1, False), ("over_speed_limit_mps", 0.021, False), ("post_ways_driven", 0.9, False)])
def test_figure_is_met_or_the_benchmark_says_so(key, value, is_good):
    rows = report(parts(**{key: value})).rows
    assert all_met(rows) == is_good
    assert any("NOT MET" in line(row) for row in rows) != is_good


def leg(result, message="", time_s=4.0):
    """Return the leg of a robot at its goal."""
    return DrivenLeg(result, message, time_s, Pose2(0.0, 0.0, 0.0), (), 1.0)


@pytest.mark.parametrize("failed", [leg(Result.REFUSED, "There is no way.", 0.02), leg(Result.PENDING, time_s=90.0),
                                    leg(Result.REACHED, "It was blocked.")])
def test_way_that_was_not_driven_is_not_the_fastest(failed):
    assert tracking.ratio_of(leg(Result.REACHED), 2.0) == 2.0
    assert tracking.ratio_of(failed, 2.0) == math.inf


def test_one_pair_that_was_not_driven_or_touched_the_car_fails_the_table():
    fine = tracking.PairOutcome(1.04, ((0.004, 0.1),) * 4, ((0.001, 0.1),) * 300, 0.3, 0, ())
    refused = replace(fine, ratio=math.inf, failures=("pair 7: REFUSED There is no way.",))
    touched = replace(fine, contacts=1)
    assert all_met(tracking.figures([fine] * 200).rows())
    for bad, name in ((refused, tracking.NOT_REACHED), (touched, tracking.CONTACTS)):
        found = tracking.figures([fine] * 199 + [bad]).rows()
        assert [row.requirement for row in found if not row.is_met] == [name]
    assert not all_met(tracking.figures([fine] * 120 + [refused] * 80).rows()[:2])


def test_robot_that_two_posts_have_slowed_keeps_its_speed_limit():
    end = posts.drive(posts.PostsDrive(0.7, 0.75))
    assert end.slowed and end.arrived
    assert end.over_mps <= posts.OVER_LIMIT.must


def test_way_that_was_not_slowed_or_not_driven_to_its_end_proves_nothing():
    fine = posts.PostsEnd(0.01, slowed=True, arrived=True)
    ways = [posts.PostsDrive(0.2, 0.65), posts.PostsDrive(0.3, 0.65)]
    assert all_met(posts.figures(ways, [fine, fine]).rows())
    for bad in (fine._replace(slowed=False), fine._replace(arrived=False), fine._replace(over_mps=0.03)):
        assert not all_met(posts.figures(ways, [fine, bad]).rows())


@pytest.mark.parametrize("number", range(3))
def test_wide_mover_is_not_touched_by_the_moving_robot(number):
    encounter = wide_encounters.drawn_of("wide", 1)[number]
    assert encounter.walk.figure == ("wheelchair", "pram", "pair")[number] and encounter.is_localized
    end = simulate(encounter)
    assert end.stopped and not end.moving


def test_lying_person_below_the_plane_is_touched_without_a_stop():
    encounter = next(each for each in wide_encounters.drawn_of("lying", 1) if each.motion == "forward")
    end = simulate(encounter)
    assert end.moving and not end.stopped


def test_running_child_and_lying_person_are_counted_and_fail_nothing():
    drawn = {name: wide_encounters.drawn_of(name, 1)[:2] for name in wide_encounters.GROUPS}
    fine, hit = EncounterEnd(False, False, 0.0, True, True), EncounterEnd(True, True, 0.4, False, True)
    ended = {name: [(encounter, hit if name in ("child", "lying") else fine) for encounter in encounters]
             for name, encounters in drawn.items()}
    found = wide_encounters.figures(ended)
    assert found.child_contacts_while_moving == found.lying_contacts_while_moving == 2
    assert found.contacts_at_mps["lying"] == [0.4, 0.4] and found.contact_seeds["wide"] == []
    assert all_met(found.rows()[1:])


def test_drawn_movers_are_as_fast_as_their_group():
    speeds = {name: [each.walk.speed_mps for each in wide_encounters.drawn_of(name, 2)[:9]]
              for name in wide_encounters.GROUPS}
    assert max(speeds["walker"]) == wide_encounters.WALKING_MPS and min(speeds["walker"]) >= 1.5
    assert set(speeds["child"]) == {wide_encounters.RUNNING_MPS} and set(speeds["lying"]) == {0.0}
    assert max(speeds["wide"]) == 1.5


def test_every_ground_is_driven_with_both_keys_and_no_drive_has_the_name_of_another():
    found = grounds.drives()
    assert len({drive.name for drive in found}) == len(found)
    for key in ("low", "raised"):
        own = [drive for drive in found if drive.key == key]
        assert {drive.slope_deg for drive in own} >= {2.0, 3.0, 4.0, 6.0}
        assert {drive.friction for drive in own} == {0.5, 0.3, 0.2, 0.15, 0.1}
        assert {drive.obstacle for drive in own} == {"", "wall", "cable"}


def test_figures_of_grounds_are_the_worst_of_their_drives():
    found = grounds.drives()
    fine = grounds.DriveEnd(20.0, 0.1, 0.5, 0.7, 3.0, False, 0)
    ends = [fine._replace(way_m=0.01) if drive.slope_deg == 6.0 and drive.driver == grounds.PLANNER else fine
            for drive in found]
    assert all_met(grounds.figures(found, ends).rows())
    bad = {grounds.SLOPE: ({"slope_deg": 3.0, "driver": "planner"}, fine._replace(least_load_n=0.5)),
           grounds.CLIMB: ({"slope_deg": 4.0, "driver": "hand"}, fine._replace(least_load_n=0.5)),
           grounds.WAY: ({"slope_deg": 2.0}, fine._replace(way_m=0.05)),
           grounds.STEEP_WAY: ({"slope_deg": 6.0, "driver": "planner"}, fine._replace(way_m=-0.2)),
           grounds.CONTACTS: ({"obstacle": "wall", "friction": 0.3}, fine._replace(touched=True)),
           grounds.CABLE_STOPS: ({"obstacle": "cable"}, fine._replace(stops=1)),
           grounds.CABLE_TILT: ({"obstacle": "cable"}, fine._replace(tilt_deg=9.0))}
    for requirement, (which, end) in bad.items():
        worst = next(index for index, drive in enumerate(found)
                     if all(getattr(drive, key) == value for key, value in which.items()))
        rows = grounds.figures(found, [*ends[:worst], end, *ends[worst + 1:]]).rows()
        assert [row.requirement for row in rows if not row.is_met] == [requirement]


def test_planner_stands_on_a_steep_slope_and_a_person_drives_off_it():
    steep = grounds.Drive("low", slope_deg=6.0)
    assert abs(grounds.simulate(steep).way_m) < grounds.STEEP_WAY.must
    by_hand = grounds.simulate(steep._replace(driver=grounds.HAND))
    assert 0.2 < by_hand.way_m < 0.5 and by_hand.least_load_n > grounds.CLIMB.must


@pytest.mark.parametrize("seed", [2, 3, 4])
def test_waves_of_one_degree_neither_slow_nor_stop_the_robot(seed):
    walls = tuple(Wall(Pose2(0.0, side, 0.0), 16.0) for side in (6.0, -6.0))
    away = grounds.FAR_AWAY
    rig = Rig(Scenario(world_from_car=away, start_in_car=away.inverse(), start_offset_m=0.0, start_offset_rad=0.0,
                       walls=walls, ground_tilt_rad=math.radians(1.0)), seed, lift_m=grounds.LIFTS_M["raised"])
    sent = [rig.step((0.5, 0.0)).linear_mps for _ in range(400)]
    assert min(sent[50:]) == pytest.approx(0.5) and rig.decision.message == ""
