"""What `make test` says at its end: the tests that failed by their names."""
# SPDX-License-Identifier: Apache-2.0
import importlib.util
import pathlib
import re

import pytest
from project import tracked

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "setup" / "run_tests.py"
FAILED = ('<testsuite failures="1"><testcase classname="place" name="test_good"/>'
          '<testcase classname="place" name="test_bad"><{kind} message="{message}">{text}</{kind}></testcase>'
          '</testsuite>')


@pytest.fixture
def runner(tmp_path):
    """The script as a module, with the results of a suite `unit` in a folder of the test."""
    spec = importlib.util.spec_from_file_location("run_tests", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.RESULTS = tmp_path
    (tmp_path / "unit").mkdir()
    return module


@pytest.mark.parametrize("kind", ["failure", "error"])
@pytest.mark.parametrize("message, text", [("It stood.&#10;more", "trace"), ("", "\nIt stood.\ntrace")])
def test_test_that_failed_is_named_with_the_first_line_of_its_reason(runner, kind, message, text):
    report = FAILED.format(kind=kind, message=message, text=text)
    (runner.RESULTS / "unit" / "a.xml").write_text(f"<testsuites>{report}</testsuites>", encoding="utf-8")
    assert runner.failures(["unit"]) == ["failed: place test_bad: It stood."]


def test_report_that_cannot_be_read_is_named(runner):
    (runner.RESULTS / "unit" / "a.xml").write_text("<testsuite", encoding="utf-8")
    assert runner.failures(["unit"]) == ["unreadable: unit/a.xml"]


def test_report_of_rostests_process_and_suites_that_did_not_run_say_nothing(runner):
    report = FAILED.format(kind="failure", message="It stood.", text="")
    (runner.RESULTS / "unit" / "rostest-a.xml").write_text(report, encoding="utf-8")
    assert runner.failures(["unit", "lint"]) == []


# A test that starts nodes takes some seconds; on a machine with a load of ten for two cores it takes minutes.
LEAST_TIME_LIMIT_S = 300.0


@pytest.mark.parametrize("path", tracked("*.test"), ids=lambda path: path.name)
def test_time_limit_of_a_rostest_ends_what_hangs_and_not_what_is_slow(path):
    limits = re.findall(r'<test [^>]*time-limit="([\d.]+)"', path.read_text(encoding="utf-8"))
    assert limits and all(float(limit) >= LEAST_TIME_LIMIT_S for limit in limits)
