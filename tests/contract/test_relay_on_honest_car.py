"""Relay resistance against the simulated Car with an extender that its bus switches, and with one that does nothing."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from honest_car import HonestCarLink

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.assistance import OUTPUT
from mtr_operator.domain.ports import HANDLE
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios.relay_resistance import SCENARIO
from mtr_operator.domain.scenarios.relay_resistance.parameters import RelayResistanceParameters
from mtr_operator.robot_link.fake import FakeRobotLink

PARAMETERS = RelayResistanceParameters(border_distance_m=2.0, maximum_distance_m=2.5, places_m=(2.5,),
                                       requests_per_place=3, measurements_distance_m=10.0, self_check=False)
CAR = """model: honest
profile: mtr_honest_car
description: Unlocks on a handle request; an extender may reach its key.
passive_entry: {{unlock_on: handle, walk_away: "off", extender_db: {extender_db}}}
noise: {{lapse: 0.0}}
"""


@pytest.mark.parametrize(("extender_db", "resistance", "unlocks"), [(60.0, "not_resistant", 3), (0.0, "bounded", 0)])
def test_extender_of_the_simulated_car_opens_it_only_where_it_carries_the_field(extender_db, resistance, unlocks,
                                                                               tmp_path):
    (tmp_path / "car.yaml").write_text(CAR.format(extender_db=extender_db), encoding="utf-8")
    car, robot = HonestCarLink(1, tmp_path, tmp_path / "car.yaml"), FakeRobotLink(1)
    robot.connect()
    progress = Progress(SCENARIO.name, PARAMETERS.to_mapping())
    Runner(SCENARIO, PARAMETERS, ControlLoop(robot, car), progress, lambda _: None).run()
    result, = progress.results
    assert (result.resistance, result.reason) == (resistance, "")
    assert (result.requests_off, result.unlocks_off, result.requests_on, result.unlocks_on) == (3, 0, 3, unlocks)
    assert result.switched_by == OUTPUT and (not unlocks or result.cause == HANDLE)
