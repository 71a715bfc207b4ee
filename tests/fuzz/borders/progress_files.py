"""Mutated progress files and journals, at the loaders of window and command line, and what is done with one taken."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import copy
import functools
import json
import math
import pathlib
import shutil

from mtr_operator.domain.errors import InvalidParameter, OperatorError, ProgressFileError
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.report.results_csv import results_csv
from mtr_operator.report.table import results_table
from mtr_operator.station.test import open_test
from mtr_operator.station.view_model import ViewModel
from mtr_operator.storage.journal.journal_file import Entry, journal_path, line_of
from mtr_operator.storage.progress_file import load_progress, save_progress
from mtr_operator.storage.store import Store

WRITTEN_BEFORE = pathlib.Path(__file__).resolve().parents[3] / "operator_gui" / "tests" / "unit" / "written_before"
NASTY = (None, True, False, 0, -1, 1, 2 ** 31, 2 ** 63, 10 ** 400, -0.0, 1e-300, 1e30, -1e30, 4.5e6, "1e999", "NaN", "",
         "x", "0", "\0", "a" * 5000, [], [1], [[]], {}, {"a": 1}, [None] * 50, math.pi)

# Scenarios of which there are files.
NAMES = sorted(path.name for path in WRITTEN_BEFORE.iterdir())


def prepare(folder):
    """The case of this border; folder: for its files."""
    documents = {name: json.loads((WRITTEN_BEFORE / name / "progress.json").read_text(encoding="utf-8"))
                 for name in NAMES}
    with_journal = {name: _with_journal(folder / name, name) for name in NAMES}

    def case(chance):
        name = chance.choice(NAMES)
        path = folder / "case" / "progress.json"
        shutil.rmtree(path.parent, ignore_errors=True)
        path.parent.mkdir()
        if chance.randrange(5):
            path.write_bytes(mutated(documents[name], chance))
        else:
            shutil.copy(with_journal[name], path)
            journal = journal_path(path)
            shutil.copy(journal_path(with_journal[name]), journal)
            journal.write_bytes(mutated_journal(journal.read_bytes(), chance))
            if chance.random() < 0.3:
                path.unlink()
        return try_file(path, name, documents[name]["parameters"])
    return case


def _with_journal(folder, name):
    """Path of a good test with progress file and journal."""
    folder.mkdir()
    path = folder / "progress.json"
    shutil.copy(WRITTEN_BEFORE / name / "progress.json", path)
    test = open_test(path)
    with Store(path, test.progress) as store:
        for result in test.progress.results:
            store.add("line_begun", {"line": result.number})
            store.add("line", {"result": result.to_document(), "frame": None})
        store.save()
    return path


def places(document, path=()):
    """Keys to every value of a document."""
    is_list = isinstance(document, list)
    for key, value in enumerate(document) if is_list else document.items() if isinstance(document, dict) else ():
        yield (*path, key)
        yield from places(value, (*path, key))


def mutated(document, chance):
    """Text of a document with one to three things changed, or cut."""
    document = copy.deepcopy(document)
    for _ in range(chance.randint(1, 3)):
        known = list(places(document))
        if not known:
            break
        *outer, key = chance.choice(known)
        inner = functools.reduce(lambda value, step: value[step], outer, document)
        change = chance.randrange(5)
        if change == 0:
            del inner[key]
        elif change == 1 and isinstance(inner, list):
            inner.insert(key, copy.deepcopy(inner[key]))
        elif change == 2 and isinstance(inner[key], (int, float)) and not isinstance(inner[key], bool):
            factor = chance.choice((-1, 0, 1e3, 1e6, 1e300))
            # A whole number of hundreds of digits is no float.
            with contextlib.suppress(OverflowError):
                inner[key] *= factor
        else:
            inner[key] = copy.deepcopy(chance.choice(NASTY))
    text = json.dumps(document).replace('"1e999"', "1e999")
    if chance.random() < 0.1:
        text = text[:chance.randrange(len(text))]
    return text.encode("utf-8", "replace")


def mutated_journal(content, chance):
    """Journal with flipped bits, cut, with lines lost or doubled, or with wrong values under a right check sum."""
    lines = content.splitlines(keepends=True)
    kind = chance.randrange(4)
    if kind == 0:
        spoilt = bytearray(content)
        for _ in range(chance.randint(1, 4)):
            spoilt[chance.randrange(len(spoilt))] ^= 1 << chance.randrange(8)
        return bytes(spoilt)
    if kind == 1:
        return content[:chance.randrange(len(content))]
    place = chance.randrange(len(lines))
    if kind == 2:
        return b"".join(lines[:place] + lines[place:place + 1] * chance.choice((0, 2)) + lines[place + 1:])
    document = json.loads(lines[place])
    try:
        values = json.loads(mutated(document["values"] or {"a": 1}, chance))
        lines[place] = line_of(Entry(document["seq"], document["kind"], values))
    except ValueError:
        return b"".join(lines[:place])
    return b"".join(lines)


def try_file(path, name, parameters):
    """Load it as the window and as the command line does; use it as they do when they take it."""
    scenario = SCENARIOS[name]
    try:
        load_progress(path, scenario, parameters)
    except ProgressFileError as error:
        _check_sentence(error)
    try:
        test = open_test(path)
    except ProgressFileError as error:
        _check_sentence(error)
        return "refused", ""
    ViewModel().take_up(test)
    assert test.is_complete in (True, False)
    save_progress(path, test.progress)
    results_csv(test.scenario, test.progress)
    assert list(results_table(test.scenario, test.progress.results)) is not None
    if test.progress.car is not None:
        test.scenario.picture(test.parameters, test.progress.car, test.progress.results)
    again = open_test(path).progress
    if again.to_document() != test.progress.to_document():
        return "taken", "what was kept is not what is read back"
    return "taken", nonsense_in(test)


def _check_sentence(error):
    assert isinstance(error, OperatorError) and str(error).endswith(".") and len(str(error)) < 1000, str(error)[:300]


def nonsense_in(test):
    """What was accepted and cannot be; empty when it all can. Told independently of the application's own limits."""
    progress, car = test.progress, test.progress.car
    if car is not None and not (0.5 < car.length < 40 and 0.3 < car.width < 8 and 0 <= car.length_sigma < 10
                                and 0 <= car.width_sigma < 10):
        return f"Car {car.length} m x {car.width} m"
    try:
        numbers = {line.number for line in test.scenario.lines(test.parameters, test.car)}
    except InvalidParameter:
        numbers = set()
    if sorted(set(progress.measured())) != progress.measured() or not set(progress.measured()) <= numbers:
        return f"lines {progress.measured()}"
    return next(filter(None, map(nonsense_in_line, progress.results)), "")


def nonsense_in_line(result):
    """The same of one line."""
    for distance in result.distances:
        is_ok = distance.status is LineStatus.OK
        value, sigma = distance.distance_m, distance.uncertainty_m
        if is_ok != (value is not None) or (value is not None and not -60 < value < 2000):
            return f"{distance.status} with {value}"
        if sigma is not None and not 0 <= sigma <= 10:
            return f"uncertainty {sigma}"
    return f"reason {result.reason[:50]!r}" if bool(result.reason) != bool(result.invalid_count) else ""
