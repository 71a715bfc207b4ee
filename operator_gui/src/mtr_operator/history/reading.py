"""Reads a test's entry from its files."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import hashlib
import json
import pathlib

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.identity.identity import NOBODY
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import STARTED
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.report.assessed import assess
from mtr_operator.report.identity.identity_rows import identity_rows

from .entry import TestEntry
from .line_pairs import Side, open_side

# 64 bits: collisions among ten thousand tests are improbable.
_MARK_LETTERS = 16


def read_entry(path: pathlib.Path) -> TestEntry:
    """Return the entry of the test in a progress file or journal; an entry with a problem if it cannot be read."""
    try:
        return entry_of(path, open_side(path))
    except OperatorError as error:
        return TestEntry(str(path), str(error))
    # One faulty file, whatever its content, must not hide the others.
    except Exception as error:
        return TestEntry(str(path), f"The test in {path} cannot be read: {type(error).__name__}: {error}")


def entry_of(path: pathlib.Path, side: Side) -> TestEntry:
    """Return the entry of a test that has been read from a file."""
    scenario, parameters, progress = side.scenario, side.parameters, side.progress
    identity, results = progress.identity or NOBODY, progress.results
    total = 0 if progress.car is None else len(scenario.lines(parameters, progress.car))
    started = progress.session.get(STARTED, "")
    known = [value for _, value in identity_rows(identity)]
    words = (path.stem, path.parent.name, scenario.title, started.replace("T", " "), *progress.session.values(), *known)
    return TestEntry(
        str(path), "", f"{scenario.name} {started}" if progress.kept is None else progress.kept.id,
        len(results) if progress.kept is None else progress.kept.entries, started, scenario.name,
        _mark_of(parameters), " ".join(filter(None, (identity.car_model, identity.car_vin))), identity.key_serial,
        identity.operator, identity.place, len(results), total, sum(1 for result in results if result.invalid_count),
        0 < total == len(results) and not progress.to_retry(), _verdict(scenario, parameters, progress),
        "\n".join(words).lower())


def _mark_of(parameters: ScenarioParameters) -> str:
    """Return a mark that is equal for equal parameters, also for a file that leaves some at their defaults."""
    plain = json.dumps(parameters.to_mapping(), sort_keys=True)
    return hashlib.sha256(plain.encode("utf-8")).hexdigest()[:_MARK_LETTERS]


def _verdict(scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress) -> str:
    if progress.limits is None or progress.car is None:
        return ""
    judgement = assess(scenario, parameters, progress).judgement
    return "" if judgement is None else judgement.verdict.word
