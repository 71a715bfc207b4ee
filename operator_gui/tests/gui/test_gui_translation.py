"""Czech is complete, and sentences from below the window are known to it."""
# SPDX-License-Identifier: Apache-2.0
import ast
import pathlib
import re
import shutil
import subprocess
from xml.etree import ElementTree

import pytest

import mtr_operator
from mtr_operator.domain.robot_status import Problem
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.gui.i18n import FOLDER, Language, duration, number
from mtr_operator.gui.names import domain_word, parameter_title
from mtr_operator.gui.sentences import in_window_words, robot_sentences, translated
from mtr_operator.gui.texts import application, judgement, parameter_docs, parameter_names, scenarios, words
from mtr_operator.report.parameter_names import parameter_name

SOURCE = pathlib.Path(mtr_operator.__file__).parent
GUI, CHECKS = SOURCE / "gui", SOURCE / "station" / "checks"
CATALOGUE = FOLDER / "mtr_operator_cs.ts"
PLACEHOLDER = re.compile(r"\{[^}]*\}")
# Where sentences for the Operator are raised or told.
LAYERS = ("domain", "storage", "station", "car_link", "history")
LINK_FILES = ("address.py", "client.py", "probe.py", "sockets.py", "access/credentials.py", "access/key_chain.py",
              "access/pairing.py")
# Raised within a layer, and caught there.
INTERNAL = ("LookupError", "ValueError", "TypeError", "BadYaml", "OSError")
# Told on the command line alone, or of the substitutes.
NOT_SHOWN = ("--continue", "of another test; choose another folder.", "parameter file", "Parameter file",
             "'parameter: value'",
             # Put together from two halves; both wholes are listed.
             "The {} {}; check the channel")


@pytest.fixture
def czech(qapp):
    language = Language()
    language.use("cs")
    yield language
    language.use("en")


def messages(path):
    for context in ElementTree.parse(path).getroot().iter("context"):
        for message in context.iter("message"):
            yield context.find("name").text, message.find("source").text, message.find("translation")


def test_every_message_has_a_finished_translation_with_the_same_placeholders():
    found = list(messages(CATALOGUE))
    assert len(found) > 300
    for context, source, translation in found:
        assert translation.get("type") is None, (context, source)
        assert translation.text, (context, source)
        count = len(PLACEHOLDER.findall(source))
        assert len(PLACEHOLDER.findall(translation.text)) == count, source
        named = {name for name in PLACEHOLDER.findall(source) if name != "{}"}
        assert named <= set(PLACEHOLDER.findall(translation.text)), source


@pytest.mark.skipif(shutil.which("pylupdate5") is None, reason="pylupdate5 is a developers' tool")
def test_catalogue_holds_exactly_what_the_code_says(tmp_path):
    fresh = tmp_path / "fresh.ts"
    sources = [str(path) for folder in (GUI, CHECKS) for path in sorted(folder.rglob("*.py"))]
    subprocess.run(["pylupdate5", *sources, "-ts", str(fresh)], check=True, capture_output=True)
    assert {message[:2] for message in messages(fresh)} == {message[:2] for message in messages(CATALOGUE)}


@pytest.mark.skipif(shutil.which("lrelease") is None, reason="lrelease is a developers' tool")
def test_compiled_catalogue_is_up_to_date(tmp_path):
    fresh = tmp_path / "fresh.qm"
    subprocess.run(["lrelease", "-silent", str(CATALOGUE), "-qm", str(fresh)], check=True)
    assert fresh.read_bytes() == CATALOGUE.with_suffix(".qm").read_bytes()


def template_of(node):
    """Literal text with {} for what varies; None for something else."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
    return None


def raised_sentences():
    files = [path for layer in LAYERS for path in (SOURCE / layer).rglob("*.py")]
    files += [SOURCE / "robot_link" / name for name in LINK_FILES]
    for path in sorted(files):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            is_said = isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "say"
            call = node if is_said else node.exc if isinstance(node, ast.Raise) else None
            if isinstance(call, ast.Call) and call.args and getattr(call.func, "id", "") not in INTERNAL:
                text = template_of(call.args[0])
                # Entries.wrong puts the profile before it.
                if text and getattr(call.func, "attr", "") == "wrong":
                    text = f"Car profile {{}}: {text}"
                if text and " " in text and not any(part in text for part in NOT_SHOWN):
                    yield pytest.param(text, id=f"{path.name}:{text[:50]}")


@pytest.mark.parametrize("text", raised_sentences())
def test_sentence_from_below_is_listed_for_translation(text):
    patterns = [re.escape(template).replace(r"\{\}", "(.+?)")
                for template in application.SENTENCES + judgement.SENTENCES]
    assert any(re.fullmatch(pattern, text.replace("{}", "4.5")) for pattern in patterns), text


def test_every_parameter_scenario_and_word_is_listed():
    for scenario in SCENARIOS.values():
        assert {scenario.title, " ".join(type(scenario).__doc__.split())} <= set(scenarios.SENTENCES)
        assert {scenario.line_word, *scenario.distance_words} <= set(words.WORDS)
        for name, declared in scenario.parameters_type.declarations().items():
            assert declared.doc in parameter_docs.SENTENCES
            assert parameter_name(name, declared) in parameter_names.NAMES
            assert parameter_title(name, declared) == parameter_name(name, declared)
        assert {choice.doc for choice in scenario.parameters_type.choices().values()} <= set(parameter_docs.SENTENCES)
        assert {flag.doc for flag in scenario.parameters_type.flags().values()} <= set(parameter_docs.SENTENCES)


@pytest.mark.parametrize("sentence", application.SENTENCES + judgement.SENTENCES)
def test_sentence_with_values_becomes_czech_with_the_same_values(czech, sentence):
    values = [f"x{index}y" for index in range(sentence.count("{}"))]
    shown = translated(sentence.format(*values))
    assert shown != sentence.format(*values)
    assert all(value in shown for value in values)


def test_sentence_within_a_sentence_and_numbers_are_translated(czech):
    assert translated("The Car fell silent: No CAN frame for 0.6 s; check the plug, the bit rate and that the Car is "
                      "awake.") == ("Auto se odmlčelo: Už 0,6 s nepřišel rámec CAN; zkontrolujte zástrčku, rychlost a "
                                    "zda je auto probuzené.")
    assert translated("axis 3 (front right): go to the start") == "osa 3 (vpředu vpravo): jízda na začátek"
    assert translated("A sentence that nobody has listed.") == "A sentence that nobody has listed."
    assert (domain_word("not reached"), number(1.25, 2), duration(3900.0)) == ("nedosaženo", "1,25", "1 h 05 min")


def test_names_of_parameters_are_quoted_as_czech_does(czech):
    said = in_window_words("Parameter passes is 9; allowed is 8.", SCENARIOS["autolock"].parameters_type)
    assert "\N{DOUBLE LOW-9 QUOTATION MARK}" in said and "\N{RIGHT DOUBLE QUOTATION MARK}" not in said


LOST = (Problem("state_machine.localization_lost_because", (), "Localization is lost. The dispatcher is late."),
        Problem("state_machine.part_silent", (("part", "dispatcher"), ("age_s", "0.6")), "The dispatcher is late."))


def test_sentence_of_the_robot_is_translated_by_its_code_also_within_one_of_the_application(czech):
    robot_sentences.learn([LOST])
    shown = "Lokalizace se ztratila. Tato část robotu mlčí už 0,6 s: řízení spojení."
    assert translated(LOST[0].text) == shown
    assert translated(f"The robot refused the waypoint: {LOST[0].text}") == f"Robot odmítl cílový bod: {shown}"


@pytest.mark.parametrize("problem", [
    Problem("", (), "Only a text."), Problem("unknown.code", (("x", "1.5"),), "Something of a robot to come, 1.5."),
    Problem("state_machine.part_silent", (("node", "dispatcher"),), "The dispatcher is silent in another way.")])
def test_sentence_of_another_version_of_the_robot_stays_english(czech, problem):
    robot_sentences.learn([(problem,)])
    assert translated(problem.text) == problem.text


def test_robot_speaks_english_with_an_english_window():
    robot_sentences.learn([LOST])
    assert translated(LOST[0].text) == LOST[0].text


def test_window_speaks_czech(start, settings_path, qtbot):
    from mtr_operator.gui.windows.connection_window import ConnectionWindow
    application_ = start()
    language = application_.language
    language.use("cs")
    window = ConnectionWindow(application_.flow, application_.flow.connecting.connection)
    qtbot.addWidget(window)
    assert window.button.text() == "Připojit"
    window.robot.host.edit.setText("300.1.1.1")
    window.button.click()
    assert window.message.text() == "Zadaná IP adresa nebo port je neplatný."
    assert window.robot.host.fault.startswith("Adresa robotu je 300.1.1.1; adresa IPv4")
    language.use("en")
