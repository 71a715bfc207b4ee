"""Wrong parameters are rejected with the parameter, its value and the allowed values."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import parameters_from
from mtr_description.base_controller import base_controller_of, base_parameters_in
from mtr_description.shipped import shipped_base, shipped_base_file
from mtr_simulation.parameters import SimulatorParameters
from mtr_simulation.physics.wheels import BaseParameters, parameters_of
from mtr_simulation.sensors.lidar import LidarParameters
from mtr_simulation.sim import SimParameters
from mtr_simulation.site.car_shape import CarShape
from mtr_simulation.site.scenario import SCENARIOS, Scenario, named_scenario


def test_defaults_are_valid():
    assert parameters_from({}, SimulatorParameters) == SimulatorParameters()


def test_values_of_the_parameter_server_are_taken():
    values = {"seed": 3, "hold_for": ["a", "/b"], "real_time_factor": 2}
    parameters = parameters_from(values, SimulatorParameters)
    assert (parameters.seed, parameters.held_by, parameters.real_time_factor) == (3, ("/a", "/b"), 2)


@pytest.mark.parametrize(("values", "expected"), [
    ({"sead": 1}, "sead is unknown"),
    ({"seed": "one"}, "seed is 'one'"),
    ({"seed": True}, "seed is True"),
    ({"seed": -1}, "seed is -1"),
    ({"scenario": "moon"}, "scenario is 'moon'; allowed is lot, far, cones, open"),
    ({"real_time_factor": -1.0}, "real_time_factor is -1"),
    ({"hold_for": "drive_control"}, "hold_for is 'drive_control'"),
])
def test_wrong_value_is_named(values, expected):
    with pytest.raises(ConfigurationError, match=expected):
        parameters_from(values, SimulatorParameters)


@pytest.mark.parametrize(("make", "expected"), [
    (lambda: CarShape(length_m=9.0), "length_m is 9 m; allowed is 3 to 6 m"),
    (lambda: CarShape(wheelbase_m=4.0), "wheelbase_m is 4 m"),
    (lambda: Scenario(friction=0.0), "friction is 0"),
    (lambda: LidarParameters(noise_m=float("nan")), "noise_m is nan"),
    (lambda: BaseParameters(max_linear_mps2=0.0), "max_linear_mps2 is 0"),
    (lambda: SimParameters(timestep_s=0.003), "timestep_s is 0.003"),
    (lambda: SimParameters(lidar=LidarParameters(rotation_s=0.05)), "rotation_s is 0.05"),
])
def test_parameter_out_of_range_is_named(make, expected):
    with pytest.raises(ConfigurationError, match=expected):
        make()


@pytest.mark.parametrize("name", SCENARIOS)
def test_surroundings_leave_room_for_the_test(name):
    scenario = named_scenario(name)
    car = scenario.world_from_car
    places = [(pole.x_m, pole.y_m) for pole in scenario.poles] + [(each.pose.x, each.pose.y)
                                                                  for each in scenario.parked_cars]
    assert all(((x - car.x) ** 2 + (y - car.y) ** 2) ** 0.5 > 8.5 for x, y in places)


def test_platform_has_the_limits_that_its_controller_is_configured_with():
    assert parameters_of(shipped_base()) == BaseParameters()
    values = base_parameters_in(shipped_base_file())
    values["linear"]["x"]["max_velocity"], values["cmd_vel_timeout"] = 1.2, 0.2
    slower = parameters_of(base_controller_of(values, "/base"))
    assert slower == BaseParameters(max_linear_mps=1.2, command_timeout_s=0.2)
    with pytest.raises(ConfigurationError, match="/base cannot be used"):
        base_controller_of({"linear": {}}, "/base")
