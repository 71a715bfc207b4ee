"""Pages and sentences claim no more for a function than the hazard file does: none of them is safe or safety-rated."""
# SPDX-License-Identifier: Apache-2.0
import ast
import pathlib
import re
from typing import Iterator, List

import hazard_file as model
import hazard_tables as page
import pytest
from test_documents import PAGES
from test_problems import ROWS

FILE = model.read()
TOP = model.TOP
# Entries of the diary remain as they were written.
DIARY = TOP / "docs/lab-notebook/changelog.md"
STATED = [each for each in PAGES if each != DIARY]
OWN = [page.PAGE, page.OPERATION, model.FILE]
TEXTS = TOP / "operator_gui/src/mtr_operator/station/checks/check_texts.py"
SAFE = re.compile(r"(?<![\w/-])(?:fail-)?safe(?:ly|ty)?\b(?!/|-operation|-rated)", re.IGNORECASE)
RATED = re.compile(r"safety[- ]rated", re.IGNORECASE)
NEGATED = re.compile(r"\b(?:no|not|none|without)\b", re.IGNORECASE)
# Phrases that claim nothing for a function of the robot.
NEUTRAL = re.compile(r"safe operation|safety relay", re.IGNORECASE)
# Pages with another meaning of the word, and the reason.
OTHER_MEANING = {
    "docs/lab-notebook/faults.md": "data that a disk reports as written",
    "docs/results.md": "passwords and files",
}
# Pages that use the thesis' term for the stop on the hand-held controller, which README.md states to be a controlled
# stop. Further pages call it that.
THESIS_TERM = {
    "CONTRIBUTING.md", "README.md", "catkin_ws/src/mtr_controller_input/README.md",
    "catkin_ws/src/mtr_core/README.md", "catkin_ws/src/mtr_dispatcher/README.md",
    "catkin_ws/src/mtr_drive_control/README.md", "catkin_ws/src/mtr_peripherals/README.md",
    "catkin_ws/src/mtr_state_machine/README.md", "docs/accuracy.md", "docs/benchmarks.md", "docs/faults-link.md",
    "docs/faults.md", "docs/lab-notebook/faults.md", "docs/lab-notebook/robot.md", "docs/lock-step.md",
    "docs/other-bases.md", "docs/peripherals.md", "docs/preflight.md", "docs/robot-motion.md",
    "docs/robot-setup.md", "firmware/README.md", "launch/README.md", "operator_gui/README.md",
}


def name(path: pathlib.Path) -> str:
    """Path below the checkout."""
    return path.relative_to(TOP).as_posix()


def sentences(path: pathlib.Path) -> List[str]:
    """Sentences and table cells of a page."""
    text = re.sub(r"\s+", " ", path.read_text(encoding="utf-8"))
    return re.split(r"(?<=[.!?:;])\s|\|", text)


def claims(texts: List[str]) -> Iterator[str]:
    """Texts that call something safe."""
    yield from (each for each in texts if SAFE.search(NEUTRAL.sub("", each)))


@pytest.mark.parametrize("path", STATED, ids=name)
def test_page_calls_no_function_safe(path):
    assert name(path) in OTHER_MEANING or list(claims(sentences(path))) == []


@pytest.mark.parametrize("path", [*STATED, model.FILE], ids=name)
def test_safety_rated_stands_in_a_negation_only(path):
    assert [each for each in sentences(path) if RATED.search(each) and not NEGATED.search(each)] == []


@pytest.mark.parametrize("text, is_claim", [
    ("The robot is safe.", True), ("It stops safely.", True), ("the safe state", True), ("A safety function.", True),
    ("ordinary fail-safe rules", True), ("[Safe operation](safe-operation.md)", False),
    ("docs/safety/README.md", False), ("No function is safety-rated.", False), ("An unsafe control action", False)])
def test_claim_is_told_from_a_name(text, is_claim):
    assert bool(list(claims([text]))) is is_claim


def test_no_sentence_for_the_operator_calls_anything_safe():
    shown = [node.value for node in ast.walk(ast.parse(TEXTS.read_text(encoding="utf-8")))
             if isinstance(node, ast.Constant) and isinstance(node.value, str)]
    assert list(claims([*(row.template for row in ROWS), *shown])) == []


def test_no_further_page_uses_the_term_of_the_thesis_for_a_controlled_stop():
    using = {name(each) for each in STATED if re.search(r"(?<!hardware )emergency stop", " ".join(sentences(each)),
                                                        re.IGNORECASE)}
    assert using <= THESIS_TERM, using - THESIS_TERM


@pytest.mark.parametrize("path", OWN, ids=name)
def test_own_pages_say_emergency_stop_of_hardware_only(path):
    text = " ".join(sentences(path))
    assert re.findall(r"(?<!hardware )emergency stop", text, re.IGNORECASE) == []


@pytest.mark.parametrize("path", [TOP / "README.md", page.PAGE, page.OPERATION], ids=name)
def test_first_pages_state_that_nothing_is_rated_and_the_stop_is_a_controlled_one(path):
    text = " ".join(sentences(path))
    assert re.search(r"No function (?:of \w+ software )?is safety-rated", text) and "controlled stop" in text


def test_no_function_claims_a_level():
    assert {each["claim"] for each in FILE.functions.values()} == {"none"}
    assert list(claims([each["name"] for each in FILE.functions.values()])) == []
