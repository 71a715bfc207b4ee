"""Sleep time against the simulated Car whose key has a motion sensor: its sleep time is known."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from honest_car import HonestCarLink

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.assistance import OUTPUT
from mtr_operator.domain.ports import HANDLE
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios.sleep_time import SCENARIO
from mtr_operator.domain.scenarios.sleep_time.parameters import SleepTimeParameters
from mtr_operator.robot_link.fake import FakeRobotLink

PARAMETERS = SleepTimeParameters(shortest_wait_s=4.0, longest_wait_s=20.0, interval_s=3.5, confirmations=1, requests=2,
                                 self_check=False)
CAR = """model: honest
profile: mtr_honest_car
description: Unlocks on a handle request; its key sleeps at rest.
passive_entry: {{unlock_on: handle, walk_away: "off"}}
key: {{sleep_after_s: {sleep_s}}}
"""


@pytest.mark.parametrize(("sleep_s", "asleep"), [(10.0, "measured"), (0.0, "later")])
def test_sleep_time_of_the_simulated_key_lies_in_the_interval(sleep_s, asleep, tmp_path):
    (tmp_path / "car.yaml").write_text(CAR.format(sleep_s=sleep_s), encoding="utf-8")
    car, robot = HonestCarLink(1, tmp_path, tmp_path / "car.yaml"), FakeRobotLink(1)
    robot.connect()
    progress = Progress(SCENARIO.name, PARAMETERS.to_mapping())
    Runner(SCENARIO, PARAMETERS, ControlLoop(robot, car), progress, lambda _: None).run()
    result, = progress.results
    assert (result.status.value, result.asleep, result.cause, result.requested_by) == ("ok", asleep, HANDLE, OUTPUT)
    if sleep_s:
        # The motion sensor feels the last centimetre of the way; the robot tells by its speed that it stands.
        assert result.answers_until_s - 0.3 <= sleep_s <= result.silent_from_s + 0.3
    else:
        assert result.answers_until_s >= PARAMETERS.longest_wait_s - 0.1
