"""Key number and doors of a lock event are recorded beside its cause, in each scenario that records one."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.domain.actions.distance import Distance
from mtr_operator.domain.geometry.axes import axes_around
from mtr_operator.domain.geometry.radials import Radial
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.ports import KEY_BUTTON, CarEvent, LockState
from mtr_operator.domain.results.carried import carried_values
from mtr_operator.domain.results.line_result import result_from_document
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.autolock_result import AutolockResult
from mtr_operator.domain.scenarios.handle_request.axis_trial import AxisTrial, axes_of
from mtr_operator.domain.scenarios.handle_request.parameters import HandleRequestParameters
from mtr_operator.domain.scenarios.line_search.attempt import AttemptMade, AttemptsMade
from mtr_operator.domain.scenarios.press.record import joined, result_of

CAR = CarDimensions(4.0, 1.8, 0.01, 0.01)
EVENT = CarEvent(2.0, 0.01, LockState.UNLOCKED, KEY_BUTTON, key_number=3, doors="driver")


def made(*distances_m, event=EVENT):
    """Attempts that worked."""
    return AttemptsMade([AttemptMade(Distance(distance_m, 0.02, 2.0).answered_by(event), True)
                         for distance_m in distances_m])


def key_press(*distances_m, event=EVENT):
    """Result of a radial, and as its progress file has it."""
    return result_of(Radial(1, 0.0, Ray(0.0, 0.0, 1.0, 0.0)), made(*distances_m, event=event))


def test_values_of_an_event_stand_beside_its_cause():
    values = carried_values("unlock_", Distance(1.0, 0.01, 2.0).answered_by(EVENT))
    assert (values["unlock_cause"], values["unlock_key_number"], values["unlock_doors"]) == (KEY_BUTTON, 3, "driver")
    silent = carried_values("", Distance(1.0, 0.01, 2.0).answered_by(CarEvent(2.0, 0.01, LockState.UNLOCKED)))
    assert (silent["cause"], silent["key_number"], silent["doors"]) == ("unknown", None, "")


def test_key_press_has_those_of_its_farthest_press():
    assert (key_press(4.0).key_number, key_press(4.0).doors) == (3, "driver")
    other = CarEvent(2.0, 0.01, LockState.UNLOCKED, KEY_BUTTON, key_number=4)
    both = joined(key_press(4.0), key_press(5.0, event=other))
    assert (both.distance_m, both.key_number, both.doors) == (5.0, 4, "")


def test_handle_request_has_those_of_its_farthest_request():
    parameters = HandleRequestParameters()
    assert len(axes_around(CAR, parameters.measurements_distance_m)) >= len(axes_of(parameters, CAR)) > 0
    result = AxisTrial(axes_of(parameters, CAR)[0], parameters, None).result(made(1.0, 1.2))
    assert (result.distance_m, result.key_number, result.doors) == (1.2, 3, "driver")


@pytest.mark.parametrize("name", [name for name, each in SCENARIOS.items()
                                  if any(column.name.endswith("cause") for column in each.result_type.columns())])
def test_every_scenario_with_a_cause_has_key_number_and_doors_behind_its_older_columns(name):
    names = [column.name for column in SCENARIOS[name].result_type.columns()]
    wanted = [f"{prefix}{what}" for prefix in (each[:-len("cause")] for each in names if each.endswith("cause"))
              for what in ("key_number", "doors")]
    assert names[-len(wanted):] == wanted


def test_result_of_a_file_from_before_has_neither():
    document = {"axis": 1, "side": "left", "origin_x_m": 0.0, "origin_y_m": 0.9, "direction_x": 0.0, "direction_y": 1.0,
                "reason": "", "unlock_status": "not_reached", "unlock_distance_m": None, "unlock_uncertainty_m": None,
                "unlock_robot_time_s": None, "lock_status": "not_reached", "lock_distance_m": None,
                "lock_uncertainty_m": None, "lock_robot_time_s": None}
    result = result_from_document(AutolockResult, document)
    assert (result.unlock_key_number, result.lock_doors) == (None, "")
    assert result_from_document(AutolockResult, {**document, "unlock_key_number": 2}).unlock_key_number == 2
