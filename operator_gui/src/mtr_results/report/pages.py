"""Self-contained HTML of one test and of a comparison, for files and for the browser."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
import math
import pathlib
from typing import Any, Mapping, Sequence

import jinja2
import markupsafe

from mtr_operator.history.line_pairs import Side
from mtr_operator.history.statistics.comparison import compare_sets
from mtr_operator.history.statistics.documents import row_document
from mtr_operator.history.statistics.texts import MEANING, row_texts
from mtr_operator.report.figures import ends_text
from mtr_operator.report.table import line_name

from .figure_texts import figure_text
from .pictures import around_car, difference_picture, overlay_picture

_TEMPLATES = pathlib.Path(__file__).parent / "templates"
_FACTS = {"test_key": "key of the test", "started": "started", "campaign": "campaign", "model": "Car's model",
          "vin": "Car's VIN", "car_software": "Car's software", "car_profile": "Car's profile",
          "key_serial": "key's serial number", "key_type": "key's type", "key_battery_v": "key's battery, V",
          "operator": "operator", "place": "place", "weather": "weather", "robot": "robot", "software": "software",
          "robot_software": "robot's software", "notes": "notes"}
Row = Mapping[str, Any]


@functools.lru_cache(maxsize=1)
def _environment() -> jinja2.Environment:
    return jinja2.Environment(loader=jinja2.FileSystemLoader(_TEMPLATES), autoescape=True, trim_blocks=True,
                              undefined=jinja2.StrictUndefined)


@functools.lru_cache(maxsize=1)
def _style() -> str:
    return (_TEMPLATES / "style.css").read_text(encoding="utf-8")


def template_text(name: str) -> str:
    """Return the text of a file next to the templates."""
    return (_TEMPLATES / name).read_text(encoding="utf-8")


def render_part(template: str, **values: Any) -> str:
    """Render a part of a page that is updated while the page is shown."""
    return _environment().get_template(template).render(**values)


def render(template: str, title: str, served: bool = False, **values: Any) -> str:
    """Render a page from its template. served: for the browser, with links to other pages; otherwise without links."""
    # The style sheet is trusted, so it is not escaped.
    return _environment().get_template(template).render(title=title, served=served,
                                                        style=markupsafe.Markup(_style()), **values)


def page_of_test(test: Row, parts: Mapping[str, Sequence[Row]], side: Side, served: bool = False,
              kept: frozenset[str] = frozenset()) -> str:
    """Return the page of one test. kept: check sums of the available files."""
    names = names_of(side)
    distances = distance_texts(side, parts["lines"], parts["measurements"])
    facts = [(title, test[name]) for name, title in _FACTS.items() if test[name] not in ("", None)]
    facts += [("equipment", " ".join(filter(None, (each["name"], each["serial"], each["calibrated"]))))
              for each in test["equipment"]]
    verdicts = [{**row, "name": names.get(row["line"], f"line {row['line']}")} for row in parts["verdicts"]
                if row["line"]]
    trials = trial_texts(parts["trials"])
    files = [{**file, "is_kept": file["sha256"] in kept} for file in parts["files"]]
    title = f"Test {test['id']}: {side.scenario.title}, {test['started'].replace('T', ' ')[:16]}"
    return render("test.html", title, served, test=test, picture=around_car(side), line_word=side.scenario.line_word,
                  distances=distances, verdicts=verdicts, facts=facts,
                  trials=trials, files=files)


def names_of(side: Side) -> dict[int, str]:
    """Return the names of the lines that have a result, by number."""
    return {result.number: line_name(side.scenario, result) for result in side.progress.results}


def distance_texts(side: Side, lines: Sequence[Row], measurements: Sequence[Row]) -> list[dict[str, str]]:
    """Return the formatted current distances, line by line."""
    names, reasons = names_of(side), {line["number"]: line["reason"] for line in lines}
    words = {word: number for number, word in enumerate(side.scenario.distance_words)}
    current = sorted((row for row in measurements if row["is_current"]),
                     key=lambda row: (row["line"], words.get(row["word"], len(words))))
    return [{"name": names[row["line"]], "word": row["word"], "text": figure_text(row), "status": row["status"],
             "interval": _interval(row), "expanded": _metres(row["expanded_m"]), "reason": reasons[row["line"]]}
            for row in current]


def trial_texts(trials: Sequence[Row]) -> list[dict[str, Any]]:
    """Return points with formatted places."""
    return [{**row, "place": _place(row)} for row in trials]


def page_of_comparison(first: Sequence[Side], second: Sequence[Side], texts: tuple[str, str],
                       served: bool = False) -> str:
    """Return the page of a comparison of two sets. texts: the sets as a person specified them."""
    comparison = compare_sets(first, second)
    pictures = [{"word": word, "overlay": overlay_picture(comparison, word),
                 "differences": difference_picture(comparison, word)} for word in comparison.tests.words]
    described = [f"{text} ({len(side)} tests)" if len(side) > 1 else f"test {text}"
                 for text, side in zip(texts, (first, second))]
    title = f"{comparison.tests.first.scenario.title}: {described[0]} and {described[1]}"
    return render("comparison.html", title, served, comparison=comparison, first=described[0], second=described[1],
                  first_text=texts[0], second_text=texts[1], pictures=pictures, meaning=MEANING,
                  differs=comparison.differing, rows=[(row_document(row), row_texts(row)) for row in comparison.rows],
                  alone=[(1, comparison.only_first), (2, comparison.only_second)])


def _interval(row: Row) -> str:
    low_m, high_m = (math.nan if row[end] is None else float(row[end]) for end in ("low_m", "high_m"))
    return ends_text(low_m, high_m) if row["has_interval"] else ""


def _metres(value: float | None) -> str:
    return "" if value is None else f"{value:.2f}"


def _place(row: Row) -> str:
    if row["distance_m"] is not None:
        return f"{row['distance_m']:.3f}"
    return "" if row["x_m"] is None else f"({row['x_m']:.3f}, {row['y_m']:.3f})"
