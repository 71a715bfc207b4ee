"""Conversion of one test to rows of the store."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
import hashlib
import json
import pathlib
import zlib
from dataclasses import dataclass
from typing import Any, Mapping

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.identity.identity import NOBODY, Identity
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.results.session_record import ROBOT_SOFTWARE, STARTED, in_utc
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.history.entry import TestEntry
from mtr_operator.history.line_pairs import Side, open_side
from mtr_operator.history.reading import entry_of
from mtr_operator.storage.journal.journal_file import Entry, journal_of
from mtr_operator.storage.progress_document import MAX_BYTES, progress_from_document
from mtr_operator.storage.recovery import progress_path

from ..errors import StoreError
from .measurements import assessment_of, line_rows, measurement_rows, verdict_rows
from .same_content import own_document
from .source import files_of
from .trials import Row, trials_of

# For copies with the same journal, the larger reach is the newer copy.
Reach = tuple[int, bool]


@dataclass(frozen=True)
class TestRecord:
    """Rows of one test, without its number in the store.

    Attributes:
        test: columns of the test itself. car, key, equipment: rows that the test refers to. files: path of each file,
        by name.
        own: contents of the test's file, without the defaults of this version of the program.
    """

    # Without this, pytest would collect the class because of its name.
    __test__ = False

    test: Row
    car: Row
    key: Row
    equipment: list[Row]
    lines: list[Row]
    measurements: list[Row]
    trials: list[Row]
    verdicts: list[Row]
    files: Mapping[str, pathlib.Path]
    own: Mapping[str, Any]

    @property
    def reach(self) -> Reach:
        """Return the number of journal entries of this copy, and whether it includes the journal."""
        return self.test["entries"], self.test["has_journal"]


def read_record(path: pathlib.Path) -> TestRecord:
    """Read the test from a progress file or journal; OperatorError with the reason if there is none."""
    side = open_side(path)
    try:
        journal = journal_of(progress_path(path))
        # Ignore a journal that does not belong to this progress.
        fits = side.progress.kept is not None and journal.mark is not None and journal.mark.id == side.progress.kept.id
        own = own_document(path, side.progress) or side.progress.to_document()
        return _record(entry_of(path, side), side, journal.entries if fits else (), files_of(path), own)
    except OperatorError:
        raise
    except (LookupError, TypeError, ValueError, ArithmeticError, AttributeError, OSError) as error:
        raise StoreError(f"The test in {path} cannot be read: {type(error).__name__}: {error}") from None


def _record(entry: TestEntry, side: Side, entries: tuple[Entry, ...],
            files: Mapping[str, pathlib.Path], own: Mapping[str, Any]) -> TestRecord:
    progress, identity = side.progress, side.progress.identity or NOBODY
    document = json.dumps(progress.to_document(), sort_keys=True, allow_nan=False).encode("utf-8")
    assessment, trials = assessment_of(side), trials_of(entries, progress.results)
    test = {"test_key": entry.test_id, "entries": entry.entries, "has_journal": bool(entries),
            "digest": hashlib.sha256(document).hexdigest(), "document": zlib.compress(document), **_session(progress),
            **{name: getattr(identity, name) for name in ("operator", "place", "weather", "notes", "key_battery_v")},
            "scenario": side.scenario.name, "car_length_m": progress.car.length if progress.car else None,
            "car_width_m": progress.car.width if progress.car else None,
            **{name: getattr(entry, name) for name in ("done", "total", "invalid", "is_complete", "verdict", "words")}}
    return TestRecord(test, {"vin": identity.car_vin, "model": identity.car_model, "software": identity.car_software},
                      {"serial": identity.key_serial, "type": identity.key_type}, _equipment(identity),
                      [*line_rows(side, {row["line"] for row in trials})], measurement_rows(side, assessment, entries),
                      trials, [*verdict_rows(assessment)], files, own)


def _session(progress: Progress) -> Row:
    session = progress.session
    started = session.get(STARTED, "")
    return {"started": started, "started_utc": in_utc(started), "car_profile": session.get("car profile", ""),
            "robot": session.get("robot", ""), "software": session.get("software", ""),
            "robot_software": session.get(ROBOT_SOFTWARE, "")}


def _equipment(identity: Identity) -> list[Row]:
    return [{name: "" if value is None else str(value) for name, value in dataclasses.asdict(each).items()}
            for each in identity.equipment]


def side_of(document: bytes) -> Side:
    """Restore the test from a compressed document, as it was at the import."""
    try:
        stored: dict[str, Any] = json.loads(_decompressed(document))
        scenario = SCENARIOS[stored["scenario"]]
        parameters = scenario.parameters_type.from_mapping(stored["parameters"])
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError, zlib.error):
        raise StoreError("The store's record of this test is damaged, or written by a newer version; import the test "
                         "again, or update this program.") from None
    return Side(scenario, parameters, progress_from_document(stored, scenario, parameters.to_mapping()))


def _decompressed(document: bytes) -> bytes:
    """Decompress a document; ValueError above the limit of a progress file: a few bytes can expand to gigabytes."""
    content = zlib.decompressobj().decompress(document, MAX_BYTES + 1)
    if len(content) > MAX_BYTES:
        raise ValueError("too long")
    return content
