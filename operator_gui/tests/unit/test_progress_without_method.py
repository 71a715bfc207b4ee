"""A test of Key press from before its method could be chosen was measured by scan, and is continued by scan."""
# SPDX-License-Identifier: Apache-2.0
import json

import pytest
from post import LIMIT_S, Post

from mtr_operator.cli import main
from mtr_operator.domain.absent_car import AbsentCarLink
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.station.connection import SIMULATED, CanChoice, Connection, LinkOpener, RobotChoice
from mtr_operator.station.events import LineMeasured, LinksOpened, Outcome, RunEnded
from mtr_operator.station.links.worker import Worker
from mtr_operator.station.test import new_test, open_test
from mtr_operator.storage.journal.journal_file import journal_path

CONNECTION = Connection(RobotChoice(SIMULATED), CanChoice(SIMULATED))
PARAMETERS = {"angle_between_radials_deg": 90.0}


class Opener(LinkOpener):
    """Hands out the links of the fixtures."""

    def __init__(self, robot, car):
        super().__init__()
        self._robot, self._car = robot, car

    def robot(self, choice):
        return self._robot

    def car(self, choice):
        return AbsentCarLink() if choice is None else self._car


@pytest.fixture
def post():
    return Post()


@pytest.fixture
def worker(robot_link, car_link, post):
    made = Worker(CONNECTION, Opener(robot_link, car_link), post.box)
    made.start()
    post.wait_for(LinksOpened)
    yield made
    assert made.close(LIMIT_S)


@pytest.fixture
def former(worker, post, tmp_path):
    """Progress file of a test that was stopped, without what later versions write of the method."""
    scenario = SCENARIOS["key_press"]
    test = new_test(scenario, scenario.parameters_type.from_mapping({**PARAMETERS, "method": "scan"}),
                    tmp_path / "progress", CONNECTION)
    worker.run_test(test)
    post.wait_for(LineMeasured)
    worker.stop()
    assert post.wait_for(RunEnded).outcome is Outcome.STOPPED
    document = json.loads(test.path.read_text(encoding="utf-8"))
    del document["parameters"]["method"], document["journal"]
    assert document["results"] and not any("method" in result for result in document["results"])
    test.path.write_text(json.dumps(document), encoding="utf-8")
    journal_path(test.path).unlink()
    return test.path


def test_test_without_a_method_is_continued_by_scan(former, worker, post):
    test = open_test(former)
    assert test.parameters.method == "scan"
    measured = list(test.progress.results)
    worker.run_test(test)
    ended = post.wait_for(RunEnded)
    assert (ended.outcome, ended.text) == (Outcome.COMPLETE, "")
    assert [result.method for result in ended.results] == ["scan"] * 4
    assert list(ended.results[:len(measured)]) == measured
    # From now on the file names it.
    assert json.loads(former.read_text(encoding="utf-8"))["parameters"]["method"] == "scan"


@pytest.mark.parametrize(("method", "code"), [("", 0), ("method: scan\n", 0), ("method: adaptive\n", 2)])
def test_command_line_continues_it_by_scan_or_says_that_it_was_measured_so(former, tmp_path, capsys, method, code):
    parameters = tmp_path / "key_press.yaml"
    parameters.write_text(f"{method}angle_between_radials_deg: 90\n", encoding="utf-8")
    done = main(["run", "key_press", "--params", str(parameters), "--out", str(tmp_path / "out"), "--continue",
                 str(former), "--simulated-robot", "--simulated-car"])
    said = capsys.readouterr().err
    assert done == code, said
    assert ("It was measured with other parameters: method was scan, now it is adaptive." in said) is bool(code)
    if not code:
        results = json.loads((tmp_path / "out" / "progress.json").read_text(encoding="utf-8"))["results"]
        assert len(results) == 4 and not any("method" in result for result in results)
