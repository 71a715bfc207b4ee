"""Whole tests from the command line in which a person takes the handle and switches the extender when asked."""
# SPDX-License-Identifier: Apache-2.0
import csv

import pytest

from mtr_operator.cli import main
from mtr_operator.domain.assistance import OPERATOR
from mtr_operator.domain.ports import HANDLE, LockFacts

HANDLE_QUESTION, EXTENDER_QUESTION = "Take the Car's handle now", "Switch the extender"
# By so much an extender, while it is switched on, has the key be nearer.
NEARER_M = 5.0
SHORT = {
    "handle_request": "side: left\nmeasurements_distance_m: 10\nattempts_limit: 12\ninterval_m: 0.5\n"
                      "handle_timeout_s: 3\n",
    "sleep_time": "side: left\nshortest_wait_s: 2\nlongest_wait_s: 4\ninterval_s: 4\nconfirmations: 1\nrequests: 2\n"
                  "handle_timeout_s: 3\n",
    "relay_resistance": "side: left\nplaces_m: [2.0]\nrequests_per_place: 2\nmeasurements_distance_m: 10\n"
                        "handle_timeout_s: 3\nswitch_timeout_s: 4\n",
}


class Person:
    """Reads each question and does it at once, then presses Enter; `leaves_at` is the question at which nobody is
    there any more. Takes the place of what reads Enter, so that no time passes between question and answer."""

    def __init__(self, world, read):
        self.asked, self.leaves_at, self.is_on = [], "", False
        self._world, self._read = world, read

    def __call__(self):
        return self

    def ask(self, answered):
        question = self._read().err.splitlines()[-1]
        self.asked.append(question)
        if self.leaves_at and self.leaves_at in question:
            return
        if question.startswith(HANDLE_QUESTION):
            self._world.take_handle()
        else:
            self._switch(question.startswith(f"{EXTENDER_QUESTION} on "))
        answered()

    def _switch(self, is_on):
        self._world.handle_m += NEARER_M * (is_on - self.is_on)
        self.is_on = is_on

    def withdraw(self, answered):
        pass

    def count(self, question):
        """How often it was asked."""
        return sum(each.startswith(question) for each in self.asked)


@pytest.fixture(name="person")
def person_fixture(monkeypatch, robot_link, car_link, world, capsys):
    """Beside a Car whose handle alone unlocks it, and which has no output for it."""
    world.unlock_m, world.lock_m, world.facts = -1.0, -1.0, LockFacts(frozenset({HANDLE}))
    found = Person(world, capsys.readouterr)
    monkeypatch.setattr("mtr_operator.cli.run.robot_link", lambda options, is_real_time: robot_link)
    monkeypatch.setattr("mtr_operator.cli.run.car_link", lambda options: car_link)
    monkeypatch.setattr("mtr_operator.cli.run.Enter", found)
    return found


def run(folder, scenario):
    """Exit code of a short test; its files are in `out`."""
    path = folder / f"{scenario}.yaml"
    path.write_text(f"{SHORT[scenario]}self_check: false\n", encoding="utf-8")
    return main(["run", scenario, "--params", str(path), "--out", str(folder / "out")])


def rows(folder):
    """Of results.csv."""
    lines = (folder / "out" / "results.csv").read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def test_handle_request_asks_for_each_of_its_requests_and_names_who_took_the_handle(person, tmp_path):
    assert run(tmp_path, "handle_request") == 0
    row, = rows(tmp_path)
    assert (row["status"], row["requested_by"]) == ("ok", OPERATOR)
    assert person.count(HANDLE_QUESTION) == len(person.asked) == int(row["requests"]) > 0
    assert float(row["d50_low_m"]) < 1.5 < float(row["d50_high_m"])


def test_sleep_time_asks_for_each_trial_of_a_key_that_never_sleeps(person, tmp_path):
    assert run(tmp_path, "sleep_time") == 0
    row, = rows(tmp_path)
    assert (row["status"], row["asleep"], row["requested_by"]) == ("ok", "later", OPERATOR)
    assert person.count(HANDLE_QUESTION) == len(person.asked) >= int(row["trials"]) > 0
    assert all("Remote key at 0.60 m, then press Enter" in each for each in person.asked)


def test_relay_resistance_asks_for_extender_and_handle_in_turn(person, tmp_path):
    assert run(tmp_path, "relay_resistance") == 0
    row, = rows(tmp_path)
    assert (row["resistance"], row["unlocks_off"], row["unlocks_on"]) == ("not_resistant", "0", "2")
    assert (row["requested_by"], row["switched_by"]) == (OPERATOR, OPERATOR)
    switches = [each.partition(";")[0] for each in person.asked if each.startswith(EXTENDER_QUESTION)]
    assert switches == [f"{EXTENDER_QUESTION} {word} now, then press Enter." for word in ("off", "on")]


@pytest.mark.parametrize("case", [
    ("handle_request", HANDLE_QUESTION, "Nobody has taken the Car's handle within 3 s"),
    ("sleep_time", HANDLE_QUESTION, "Nobody has taken the Car's handle within 3 s"),
    ("relay_resistance", f"{EXTENDER_QUESTION} on", "Nobody has switched the extender within 4 s")])
def test_person_who_has_left_ends_the_test_with_a_sentence(person, tmp_path, capsys, case):
    scenario, question, sentence = case
    person.leaves_at = question
    assert run(tmp_path, scenario) == 2
    told = capsys.readouterr().err
    assert told.count(sentence) == 1 and "Traceback" not in told
    assert not (tmp_path / "out" / "results.csv").exists()
