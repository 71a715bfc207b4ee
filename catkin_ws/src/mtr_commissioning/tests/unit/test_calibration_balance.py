"""Weighing of synthetic robots: the true values are recovered within the uncertainty, and optimism is reported."""
# SPDX-License-Identifier: Apache-2.0
import math
import random
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mtr_commissioning.calibration.balance.comparison import optimistic, values_to_set
from mtr_commissioning.calibration.balance.estimate import balance_of, limit_mps2
from mtr_commissioning.calibration.balance.guide import TIPPING_SHARE
from mtr_commissioning.calibration.balance.readings import Chassis, Level, Raised, Tilt
from mtr_commissioning.calibration.console import Console
from mtr_commissioning.calibration.guides import GUIDES
from mtr_commissioning.calibration.readings import ReadingsUnusable
from mtr_description.shipped import shipped_geometry

CHASSIS = Chassis(0.262, 0.376, 0.098)
STEP_KG = 0.005
KEYS_M = (0.35, 1.55)


class Body:
    """Robot with known masses; it is weighed by statics alone, without the formulas of the code.

    The contact points of the wheels carry vertical forces in the plane of the axles, and their moments balance.
    """

    def __init__(self, *, mass_kg=25.0, ahead_m=0.003, left_m=-0.004, low_m=0.2665, rise=0.0345):
        self.mass_kg, self.ahead_m, self.left_m = mass_kg, ahead_m, left_m
        self.low_m, self.rise, self.chassis = low_m, rise, CHASSIS

    def height_m(self, key_height_m):
        return self.low_m + self.rise * key_height_m

    def level(self, noise=lambda: 0.0):
        front = 0.5 + self.ahead_m / self.chassis.base_m
        left = 0.5 + self.left_m / self.chassis.track_m
        return Level(*(self.mass_kg * share + noise() for share in (front, 1.0 - front, left, 1.0 - left)))

    def raised(self, key_height_m, rise_m, noise=lambda: 0.0):
        pitch = math.asin(rise_m / self.chassis.base_m)
        # Positions in the world, from the rear axle; the body is turned by the pitch, nose up.
        forward, up = 0.5 * self.chassis.base_m + self.ahead_m, self.height_m(key_height_m) - self.chassis.radius_m
        centre_x = forward * math.cos(pitch) - up * math.sin(pitch)
        front_kg = self.mass_kg * centre_x / (self.chassis.base_m * math.cos(pitch))
        return Raised(key_height_m, rise_m, front_kg + noise(), self.mass_kg - front_kg + noise())

    def tilt(self, key_height_m, across):
        """Return the angle at which the centre of mass is exactly above the lower contact points."""
        lever_m = (0.5 * self.chassis.track_m + self.left_m if across
                   else 0.5 * self.chassis.base_m + self.ahead_m)
        low, high = 0.0, 0.5 * math.pi
        for _ in range(60):
            angle = 0.5 * (low + high)
            beyond_m = lever_m * math.cos(angle) - self.height_m(key_height_m) * math.sin(angle)
            low, high = (angle, high) if beyond_m > 0.0 else (low, angle)
        return Tilt(key_height_m, math.degrees(low), across)

    def readings(self, draw=None):
        noise = (lambda: 0.0) if draw is None else (lambda: draw.uniform(-0.5, 0.5) * STEP_KG)
        levels = [self.level(noise) for _ in range(3)]
        return levels, [self.raised(key, rise, noise) for key in KEYS_M for rise in (0.02, 0.026)]

    def parameters(self):
        return {"centre_of_mass_m": self.low_m, "centre_of_mass_rise": self.rise,
                "tip_lever_along_m": 0.5 * self.chassis.base_m - abs(self.ahead_m),
                "tip_lever_across_m": 0.5 * self.chassis.track_m - abs(self.left_m)}


BODIES = st.builds(Body, mass_kg=st.floats(15.0, 60.0), ahead_m=st.floats(-0.03, 0.03), left_m=st.floats(-0.04, 0.04),
                   low_m=st.floats(0.18, 0.32), rise=st.floats(0.0, 0.06))


@settings(max_examples=60, deadline=None)
@given(body=BODIES)
def test_exact_readings_of_any_robot_give_its_balance(body):
    levels, raised = body.readings()
    found = balance_of(CHASSIS, levels, raised, [], STEP_KG)
    assert found.mass.value == pytest.approx(body.mass_kg)
    assert (found.ahead.value, found.left.value) == pytest.approx((body.ahead_m, body.left_m), abs=1e-9)
    for name, estimate in found.parameters().items():
        assert estimate.value == pytest.approx(body.parameters()[name], abs=1e-9)
        assert estimate.sigma > 0.0


@settings(max_examples=30, deadline=None)
@given(body=BODIES)
def test_tilt_table_alone_gives_the_same_height(body):
    tilts = [body.tilt(key, across) for key in KEYS_M for across in (False, True)]
    found = balance_of(CHASSIS, body.readings()[0], [], tilts, STEP_KG)
    assert (found.low.value, found.rise.value) == pytest.approx((body.low_m, body.rise), abs=1e-9)


def test_result_is_as_far_off_as_its_sigma_says():
    body, squares = Body(), []
    for seed in range(200):
        draw = random.Random(seed)
        levels, raised = body.readings(draw)
        # Blocks are measured with a caliper to half a millimetre.
        raised = [body.raised(each.key_height_m, each.rise_m + draw.gauss(0.0, 0.0005)) for each in raised]
        raised = [Raised(each.key_height_m, rise_m, each.front_kg, each.rear_kg)
                  for each, rise_m in zip(raised, (0.02, 0.026) * 2)]
        found = balance_of(CHASSIS, levels, raised, [], STEP_KG)
        squares.append(((found.low.value - body.low_m) / found.low.sigma) ** 2)
    assert 0.5 < sum(squares) / len(squares) < 1.3


def test_readings_that_contradict_each_other_are_refused():
    body = Body()
    levels, raised = body.readings()
    with pytest.raises(ReadingsUnusable, match="contradict each other"):
        balance_of(CHASSIS, levels, [*raised[:3], Body(low_m=0.4).raised(KEYS_M[1], 0.026)], [], STEP_KG)
    with pytest.raises(ReadingsUnusable, match="add up to"):
        Level(12.0, 13.0, 10.0, 13.0)
    with pytest.raises(ReadingsUnusable, match="add up to"):
        balance_of(CHASSIS, levels, [*raised[:3], Raised(KEYS_M[1], 0.026, 20.0, 20.0)], [], STEP_KG)


@pytest.mark.parametrize(("changed", "words"), [
    ({"rise_m": 0.014}, "at least 15 mm"), ({"rise_m": 0.262}, "less than the wheels' base"),
    ({"rise_m": math.nan}, "at least 15 mm"), ({"front_kg": 2.0, "rear_kg": 23.0}, "near to tipping"),
    ({"front_kg": math.nan}, "add up to"), ({"front_kg": 0.0, "rear_kg": 0.0}, "add up to")])
def test_foolish_reading_with_raised_wheels_is_refused(changed, words):
    reading = {"key_height_m": 0.35, "rise_m": 0.02, "front_kg": 12.0, "rear_kg": 13.0, **changed}
    with pytest.raises(ReadingsUnusable, match=words):
        Raised(**reading).height(CHASSIS, 25.0, 0.0, STEP_KG)


@pytest.mark.parametrize("angle_deg", [0.9, 60.1, -20.0, math.nan])
def test_foolish_angle_is_refused(angle_deg):
    with pytest.raises(ReadingsUnusable, match="between 1 and 60"):
        Tilt(0.35, angle_deg, False).height(CHASSIS, 0.0, 0.0)


@pytest.mark.parametrize(("count", "words"), [(3, "read 3 times"), (0, "read 0 times")])
def test_too_few_heights_are_refused(count, words):
    levels, raised = Body().readings()
    with pytest.raises(ReadingsUnusable, match=words):
        balance_of(CHASSIS, levels, raised[:count], [], STEP_KG)


def test_heights_with_one_place_of_the_key_are_refused():
    body = Body()
    raised = [body.raised(key, 0.02) for key in (0.35, 0.4, 0.5, 0.64)]
    with pytest.raises(ReadingsUnusable, match="0.29 m apart"):
        balance_of(CHASSIS, body.readings()[0], raised, [], STEP_KG)


def test_one_weighing_is_refused():
    levels, raised = Body().readings()
    with pytest.raises(ReadingsUnusable, match="at least 2"):
        balance_of(CHASSIS, levels[:1], raised, [], STEP_KG)


@settings(max_examples=60, deadline=None)
@given(body=BODIES, tip=st.sampled_from(["centre_of_mass_m", "tip_lever_along_m", "tip_lever_across_m"]))
def test_description_that_tips_later_than_the_robot_is_named_and_another_is_not(body, tip):
    found = balance_of(CHASSIS, *body.readings(), [], STEP_KG)
    true = body.parameters()
    assert optimistic(found, true, list(KEYS_M)) == []
    pessimistic = {**true, tip: true[tip] * (1.2 if tip == "centre_of_mass_m" else 0.8)}
    assert optimistic(found, pessimistic, list(KEYS_M)) == []
    sentences = optimistic(found, {**true, tip: true[tip] * (0.75 if tip == "centre_of_mass_m" else 1.3)}, list(KEYS_M))
    assert len(sentences) == (4 if tip == "centre_of_mass_m" else 2)
    assert all(sentence.startswith("WARNING: with the key at ") for sentence in sentences)


@settings(max_examples=60, deadline=None)
@given(body=BODIES, key_height_m=st.floats(0.35, 1.55))
def test_values_to_set_are_never_rounded_to_a_later_tip(body, key_height_m):
    found = balance_of(CHASSIS, *body.readings(), [], STEP_KG)
    measured, values = ({name: each.value for name, each in found.parameters().items()}, values_to_set(found))
    for lever in ("tip_lever_along_m", "tip_lever_across_m"):
        limit = limit_mps2(values, lever, key_height_m)
        assert limit <= limit_mps2(measured, lever, key_height_m) * (1.0 + 1e-6)
        assert limit == pytest.approx(limit_mps2(measured, lever, key_height_m), rel=0.01)


def guided(body, tilts=()):
    """Return the guide's output for a person who weighs this body with the shipped description, and its checks."""
    geometry = shipped_geometry()
    wheels = geometry.wheels()
    body.chassis = Chassis(wheels.base_m, wheels.track_m, wheels.radius_m)
    key = geometry.key()
    heights = iter([key.min_height_m, key.max_height_m, *(each.key_height_m for each in tilts)])
    level = body.level()
    answers = [5, 2, *[level.front_kg, level.rear_kg, level.left_kg, level.right_kg] * 2]
    for height_m in (key.min_height_m, key.max_height_m):
        for rise_m in (0.02, 0.025):
            raised = body.raised(height_m, rise_m)
            answers += [1000.0 * rise_m, raised.front_kg, raised.rear_kg]
    answers.append(len(tilts))
    for each in tilts:
        answers += ["y" if each.across else "n", each.angle_deg]
    script, said = iter(map(str, answers)), []
    console = Console(lambda question: "" if question.endswith("Enter. ") else next(script), said.append)
    robot = SimpleNamespace(geometry=lambda: geometry, key_height_m=lambda: next(heights))
    checks = GUIDES["balance"](console, robot)
    assert next(script, None) is None
    return {check.name: check.estimate.value for check in checks}, said


def test_guide_leads_to_the_parameters_of_drive_control_and_warns_of_a_heavier_mast():
    found, said = guided(Body(mass_kg=28.0, low_m=0.30, rise=0.06))
    assert found["mass_kg"] == pytest.approx(28.0) and found["centre_of_mass_m"] == pytest.approx(0.30, abs=1e-4)
    assert found["centre_of_mass_rise"] == pytest.approx(0.06, abs=1e-4)
    assert sum(sentence.startswith("WARNING") for sentence in said) == 4
    assert any(sentence.startswith("centre_of_mass_m: 0.3000 ") or sentence.startswith("centre_of_mass_m: 0.3001 ")
               for sentence in said)


def test_guide_takes_a_tilt_table_too_and_warns_of_nothing_on_a_robot_that_tips_later():
    body = Body(low_m=0.2, rise=0.02, ahead_m=0.0, left_m=0.0)
    geometry = shipped_geometry().wheels()
    body.chassis = Chassis(geometry.base_m, geometry.track_m, geometry.radius_m)
    found, said = guided(body, [body.tilt(0.35, True), body.tilt(1.0, False)])
    assert found["centre_of_mass_m"] == pytest.approx(0.2, abs=1e-3)
    assert not any(sentence.startswith("WARNING") for sentence in said)


def test_block_of_the_guide_leaves_most_of_the_tipping_angle():
    assert TIPPING_SHARE <= 0.3
