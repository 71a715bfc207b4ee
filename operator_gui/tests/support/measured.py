"""Tests as they lie in folders after measuring: radials of Key press by search, with a journal where it is wanted."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.domain.results.journal import BEGUN, LINE, LINE_BEGUN, POINT
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.progress import JournalMark, Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.history.line_pairs import Side
from mtr_operator.report import results_csv
from mtr_operator.storage.journal.journal_file import Entry, journal_path, line_of
from mtr_operator.storage.progress_file import FILE_NAME, save_progress

SCENARIO = SCENARIOS["key_press"]
CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
LINES = 4
HALF_M = 0.3
STARTED = "2026-11-22T15:36:43+01:00"


def parameters(lines=LINES):
    return SCENARIO.parameters_type(method="adaptive", angle_between_radials_rad=2.0 * math.pi / lines)


def searched(number, distance_m, half_m=HALF_M, lines=LINES, **changes):
    """A radial of a search with this border and half width of its interval; 3 presses worked, 2 failed."""
    values = {"d50_m": distance_m, "d50_sigma_m": half_m / SIGMAS_OF_LEVEL, "d50_low_m": distance_m - half_m,
              "d50_high_m": distance_m + half_m, "worked_at_m": (3.0, 3.5, distance_m - 0.1),
              "failed_at_m": (distance_m + 0.4, distance_m + 0.8), "place_sigma_m": 0.002, **changes}
    attempts = values.pop("attempts", 5)
    return KeyPressResult(number, 360.0 / lines * (number - 1), LineStatus.OK, distance_m, distance_m + 0.5, 0.01,
                          attempts, 1.0, "", method="adaptive", reach="measured", **values)


def at_least(number, distance_m, lines=LINES):
    """A radial whose border lies beyond its places."""
    return searched(number, distance_m, 0.0, lines, d50_m=None, d50_sigma_m=None, d50_high_m=None)


def progress(*results, started=STARTED, mark="a1", lines=LINES, **changes):
    """Of results, or of borders in m."""
    made = [searched(number, result, lines=lines) if isinstance(result, float) else result
            for number, result in enumerate(results, start=1)]
    return Progress(SCENARIO.name, parameters(lines).to_mapping(),
                    {"started": started, "software": "mtr-operator 0.2.0", "car profile": "mtr_demo_car"}, CAR, made,
                    kept=JournalMark(mark, 10 + len(made)), **changes)


def side(*results, lines=LINES, **changes):
    return Side(SCENARIO, parameters(lines), progress(*results, lines=lines, **changes))


def in_folder(folder, *results, **changes):
    """A test with its record and its table; the path of its progress file."""
    folder.mkdir(parents=True, exist_ok=True)
    made = progress(*results, **changes)
    save_progress(folder / FILE_NAME, made)
    (folder / results_csv.FILE_NAME).write_text(results_csv.results_csv(SCENARIO, made), encoding="utf-8")
    return folder / FILE_NAME


def journalled(folder, attempts, lines=LINES, mark="a1", ends=True):
    """A test of one radial, measured again and again: one border in m for each attempt. ends: the last one has come to
    its result. The path of its progress file, which is written when a line is."""
    folder.mkdir(parents=True, exist_ok=True)
    begun = progress(mark=mark, lines=lines)
    begun.kept = None
    entries = [(BEGUN, {"format": "mtr-operator journal", "version": 1, "id": mark, "progress": begun.to_document()})]
    for index, distance_m in enumerate(attempts, start=1):
        entries.append((LINE_BEGUN, {"line": 1}))
        entries += [(POINT, point(f"press {press}", place_m, place_m < distance_m))
                    for press, place_m in enumerate((3.0, distance_m - 0.1, distance_m + 0.4), start=1)]
        if ends or index < len(attempts):
            entries.append((LINE, {"result": searched(1, distance_m, lines=lines).to_document(), "frame": None}))
            begun.record(searched(1, distance_m, lines=lines))
            begun.kept = JournalMark(mark, len(entries))
    save_progress(folder / FILE_NAME, begun)
    content = b"".join(line_of(Entry(number, *entry)) for number, entry in enumerate(entries, start=1))
    journal_path(folder / FILE_NAME).write_bytes(content)
    return folder / FILE_NAME


def point(word, distance_m, worked):
    distance = {"distance_m": distance_m, "uncertainty_m": 0.002, "robot_time_s": 9.0, "lateral_m": 0.0,
                "heading_rad": 0.0, "key_height_m": 1.0, "speed_mps": 0.0, "source": "key_button" if worked else ""}
    return {"word": word, "status": "ok" if worked else "not_reached", "distance": distance, "frame": None}
