"""Choice of a Car by its file: shipped files, wrong files, and byte-identical frames of the gentle Car."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import hashlib

import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.parameters import LIMITS, figure, parameters_from
from mtr_simulation.car.can_port import MemoryCanPort
from mtr_simulation.car.car import SimulatedCar
from mtr_simulation.car.choice import FOLDER, car_names, chosen_car
from mtr_simulation.car.honest.car import STEP_NS, HonestCar
from mtr_simulation.car.honest.parameters import HonestParameters
from mtr_simulation.parameters import SimulatorParameters
from mtr_simulation.truth.log import NoTruthLog, TruthLog

# Digest of the frames and true events of the course below, from the simulation before honest Cars were added.
GENTLE_DIGEST = "71a3c3037e507f5ed6453e0e49a692999a15a98683cb17de15898568a4105fa0"


def course():
    """Key positions and servo pulse widths: to the left door and back, then presses on the way to the front."""
    for step in range(400):
        yield (0.2, 4.5 - 0.008 * step, 1.0), (1000, 1000)
    for step in range(400):
        yield (0.2, 1.3 + 0.008 * step, 1.0), (1000, 1000)
    for step in range(600):
        pressed = step % 50 < 20
        pulses = (2000, 1000) if step // 50 % 2 else (1000, 2000)
        yield (2.5 + 0.008 * step, 0.5, 0.9), pulses if pressed else (1000, 1000)


def run(choice, seed, log):
    """CAN frames of the Car during the course."""
    port = MemoryCanPort()
    car = choice.car(seed, port, log)
    for step, (key_xyz, servo_us) in enumerate(course()):
        car.step(1_000_000_000 + step * STEP_NS, key_xyz, servo_us, 0.001 * step)
    return port.frames


def test_gentle_car_is_the_one_that_it_was_to_the_byte(tmp_path):
    log = TruthLog(tmp_path)
    frames = run(chosen_car("gentle"), 1, log)
    log.close()
    digest = hashlib.sha256(repr([tuple(frame) for frame in frames]).encode())
    digest.update(log.path.read_bytes())
    assert digest.hexdigest() == GENTLE_DIGEST


def test_gentle_is_the_default():
    assert parameters_from({}, SimulatorParameters).car == "gentle"
    assert isinstance(chosen_car("gentle").car(1, MemoryCanPort(), NoTruthLog()), SimulatedCar)


def test_gentle_car_has_no_handle(tmp_path):
    log = TruthLog(tmp_path)
    car = chosen_car("gentle").car(1, MemoryCanPort(), log)
    for step in range(100):
        car.request_handle()
        car.step(1_000_000_000 + step * STEP_NS, (0.0, 9.0, 1.0), (1000, 1000))
    assert len(log.path.read_text(encoding="utf-8").splitlines()) == 1


@pytest.mark.parametrize("name", car_names())
def test_shipped_car_loads_runs_and_has_probabilities(name):
    choice = chosen_car(name)
    assert choice.name == name
    assert len(run(choice, 1, NoTruthLog())) > 100
    if name != "gentle":
        assert isinstance(choice.car(1, MemoryCanPort(), NoTruthLog()), HonestCar)


def test_there_is_a_gentle_car_and_a_few_honest_ones():
    assert {"gentle", "honest"} < set(car_names())
    assert len(car_names()) >= 4


@pytest.mark.parametrize("name", ["honest", "honest_868"])
def test_same_seed_gives_the_same_course_to_the_byte_and_another_seed_another(name, tmp_path):
    logs = [TruthLog(tmp_path / letter) for letter in "abc"]
    frames = [run(chosen_car(name), seed, log) for seed, log in zip((3, 3, 4), logs)]
    events = [log.path.read_text(encoding="utf-8") for log in logs]
    assert (frames[0], events[0]) == (frames[1], events[1])
    assert frames[0] != frames[2]
    assert events[0] != events[2]


def test_car_of_a_file_elsewhere_is_taken(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("model: honest\nprofile: mine\nplace_seed: 9\nbus: {lock_cycle_ms: 800}\n", encoding="utf-8")
    choice = chosen_car(str(path))
    assert (choice.name, choice.profile, choice.honest.place_seed, choice.honest.bus.lock_cycle_ms) == (
        "mine", "mine", 9, 800)


HONEST = "model: honest\nprofile: p\n"


@pytest.mark.parametrize(("content", "words"), [
    ("[1, 2]", "no table"),
    ("{", "not valid YAML"),
    ("profile: p\n", "model is None; allowed is gentle or honest"),
    ("model: honest\n", "lacks the entry profile"),
    ("model: gentle\nprofile: p\nuhf: {}\n", "uhf is no entry of the gentle Car"),
    (HONEST + "colour: red\n", "Entry colour is unknown; allowed are model, description, profile, place_seed, uhf"),
    (HONEST + "uhf: 434\n", "Section uhf is 434"),
    (HONEST + "uhf: {power: 1}\n", "Parameter power is unknown"),
    (HONEST + "uhf: {frequency_mhz: 2400}\n", "uhf.frequency_mhz is 2400 MHz; allowed is 300 to 1000 MHz"),
    (HONEST + "noise: {lapse: .nan}\n", "noise.lapse is nan"),
    (HONEST + "bus: {lock_cycle_ms: 1000}\n", "bus.lock_cycle_ms is 1000 ms; allowed is 20 to 800 ms"),
    (HONEST + "bus: {cause_in: letter}\n", "bus.cause_in is 'letter'; allowed is same, other, none"),
    (HONEST + "passive_entry: {unlock_on: wish}\n", "unlock_on is 'wish'; allowed is approach, handle"),
    (HONEST + "passive_entry: {walk_away: never}\n", "walk_away is 'never'; allowed is distance, delay, off"),
    (HONEST + "passive_entry: {lock_threshold_db: 3}\n", "lock_threshold_db is 3 dB; allowed is up to unlock"),
    (HONEST + "passive_entry: {poll_period_ms: 700, debounce_polls: 5}\n", "less than 5 polls of 700 ms take"),
    (HONEST + "locks: {unlock_doors: two}\n", "unlock_doors is 'two'; allowed is all, driver"),
    (HONEST + "place_seed: -1\n", "place_seed is -1"),
])
def test_wrong_file_is_refused_with_a_sentence_that_names_it(tmp_path, content, words):
    path = tmp_path / "car.yaml"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(ConfigurationError) as raised:
        chosen_car(str(path))
    assert words in str(raised.value)
    assert str(path) in str(raised.value)


def test_unknown_car_names_the_shipped_ones_and_a_missing_file_its_path():
    with pytest.raises(ConfigurationError, match="car is 'unreal'; allowed is gentle, honest, honest_868"):
        parameters_from({"car": "unreal"}, SimulatorParameters)
    with pytest.raises(ConfigurationError, match=r"nowhere\.yaml cannot be read: No such file"):
        chosen_car("nowhere.yaml")
    assert all(path.suffix == ".yaml" for path in FOLDER.iterdir())


SECTIONS = [item for item in dataclasses.fields(HonestParameters) if dataclasses.is_dataclass(item.default)]


@pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.name)
def test_page_tells_range_and_default_of_each_parameter(section):
    page = FOLDER.with_name("README.md").read_text(encoding="utf-8").splitlines()
    for item in dataclasses.fields(section.default):
        (row,) = (line.split(" | ") for line in page if line.startswith(f"| `{section.name}` | `{item.name}` | "))
        default = str(item.default).lower() if isinstance(item.default, (bool, str)) else figure(item.default)
        assert row[3] == default
        assert row[2] == str(item.metadata[LIMITS]) if LIMITS in item.metadata else default in row[2].split(", ")
