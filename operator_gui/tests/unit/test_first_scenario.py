"""The scenario in the README is complete: it runs with `lines` and `measure` alone."""
# SPDX-License-Identifier: Apache-2.0
import importlib.util
import pathlib
import re
import sys

import pytest

from mtr_operator.domain.interfaces import scenario_parts
from mtr_operator.domain.results.line_result import LineStatus, result_from_document
from mtr_operator.domain.scenario import Scenario
from mtr_operator.report.results_csv import results_csv
from mtr_operator.station.estimate import USUAL_CAR, plan_of

README = pathlib.Path(__file__).parents[2] / "README.md"
PARTS = [value for value in vars(scenario_parts).values()
         if isinstance(value, type) and value.__module__ == scenario_parts.__name__]


@pytest.fixture(name="module")
def fixture_module(tmp_path, monkeypatch):
    """The module in the section on new scenarios."""
    section = README.read_text(encoding="utf-8").partition("## Writing a new scenario\n")[2].partition("\n## ")[0]
    code, = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    path = tmp_path / "front_unlock.py"
    path.write_text(code, encoding="utf-8")
    spec = importlib.util.spec_from_file_location("front_unlock", path)
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "front_unlock", module)
    spec.loader.exec_module(module)
    return module


def test_scenario_of_the_readme_offers_no_optional_part(module):
    assert len(PARTS) == 6
    assert not isinstance(module.SCENARIO, tuple(PARTS))
    assert set(vars(type(module.SCENARIO))) & {"lines", "measure", "picture"} == {"lines", "measure"}
    assert type(module.SCENARIO).picture is Scenario.picture


def test_scenario_of_the_readme_measures_its_first_line(module, world, run_scenario):
    result, = run_scenario(module.SCENARIO, module.Parameters())
    assert (result.number, result.side, result.status, result.reason) == (1, "front", LineStatus.OK, "")
    assert result.distance_m == pytest.approx(world.unlock_m, abs=0.05)
    assert result_from_document(module.Result, result.to_document()) == result


def test_scenario_of_the_readme_reports_a_car_that_stays_locked(module, world, run_scenario):
    world.unlock_m = 0.2
    assert {each.status for each in run_scenario(module.SCENARIO, module.Parameters())} == {LineStatus.NOT_REACHED}


def test_scenario_of_the_readme_reports_a_bus_that_falls_silent(module, world, run_scenario):
    world.car_problem = lambda time_s: "The bus is silent." if 2.5 < world.gap_m() < 3.0 else ""
    result, = run_scenario(module.SCENARIO, module.Parameters())
    assert result.status is LineStatus.INVALID and "The bus is silent." in result.reason


def test_views_and_files_need_no_more_of_it(module, run_scenario):
    parameters = module.Parameters()
    result, = run_scenario(module.SCENARIO, parameters)
    plan = plan_of(module.SCENARIO, parameters, USUAL_CAR, True)
    assert plan.forecast is None and len(plan.stretches) == 1
    picture = module.SCENARIO.picture(parameters, run_scenario.progress.measured_car, [result])
    assert [len(each.known) for each in picture.point_sets] == [1]
    assert "front" in results_csv(module.SCENARIO, run_scenario.progress)
