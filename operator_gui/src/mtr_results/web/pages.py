"""Page for each address; read-only."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from typing import Any, Mapping
from urllib.parse import urlencode

from mtr_operator.history.same_lines import Tests
from mtr_operator.report.table import line_name

from ..errors import StoreError
from ..report.pages import page_of_comparison, page_of_test, render
from ..report.pictures import trend_picture
from ..statistics.trend import trend
from ..store import reading
from ..store.database import Database
from ..store.kept_files import KeptFiles
from ..store.reading import PAGE, Search
from ..store.sets import read_set

# Largest number of charts on one page; more would be hard to find.
_MAX_CHARTS = 12
_CHOICES = ("scenario", "car", "software", "key", "verdict", "campaign", "place")
_TYPED = ("text", "since", "until")


class Pages:
    """Pages of a store, as text; StoreError and OperatorError are sentences for the user of the browser."""

    def __init__(self, database: Database, files: KeptFiles | None):
        self._database = database
        self._files = files

    def tests(self, query: Mapping[str, str]) -> str:
        """Return the list of matching tests."""
        offset = _number(query, "from")
        wanted: dict[str, Any] = {name: query.get(name, "") for name in (*_CHOICES, *_TYPED)}
        search = Search(offset=offset, **wanted)
        with self._database.reading() as connection:
            tests, total = reading.find(connection, search), reading.count(connection, search)
            choices = reading.values_of(connection)
        kept = {name: value for name, value in query.items() if value and name != "from"}
        return render("list.html", "Tests", True, search=dataclasses.asdict(search), tests=tests, total=total,
                      choices={name: choices[name] for name in _CHOICES if choices[name]},
                      before=_address(kept, offset - PAGE) if offset else None,
                      after=_address(kept, offset + PAGE) if offset + PAGE < total else None)

    def test(self, number: int, served: bool = True) -> str:
        """Return the page of one test; served=False makes a report without links."""
        with self._database.reading() as connection:
            test, parts = reading.test_row(connection, number), reading.parts(connection, number)
            side = reading.side(connection, number)
        return page_of_test(test, parts, side, served, self._kept(parts["files"]))

    def test_document(self, number: int) -> dict[str, Any]:
        """Return the same document as mtr-results show --json."""
        with self._database.reading() as connection:
            return {**reading.test_row(connection, number), **reading.parts(connection, number)}

    def comparison(self, query: Mapping[str, str], served: bool = True) -> str:
        """Return the comparison of two tests or sets."""
        texts = query.get("first", ""), query.get("second", "")
        with self._database.reading() as connection:
            first, second = (read_set(connection, text) for text in texts)
        return page_of_comparison(first.sides, second.sides, texts, served)

    def trend(self, query: Mapping[str, str]) -> str:
        """Return the distances of a set over time."""
        text, line, baseline = query.get("set", ""), _number(query, "line"), _number(query, "baseline")
        return render("trend.html", "Over time", True, text=text, line=line or "", baseline=baseline,
                      charts=self._charts(text, line, baseline) if text else [])

    def file(self, number: int, name: str) -> bytes:
        """Return a file of a test.

        Only names in the store are valid, so other files of this computer are not accessible.
        """
        with self._database.reading() as connection:
            files = {row["name"]: row["sha256"] for row in reading.parts(connection, number)["files"]}
        if name not in files or self._files is None:
            raise StoreError(f"The store has no file {name} of test {number}.")
        return self._files.read(files[name])

    def _charts(self, text: str, line: int, baseline: int) -> list[dict[str, str]]:
        with self._database.reading() as connection:
            chosen = read_set(connection, text)
        tests, charts = Tests(chosen.sides), []
        names = [f"test {row['id']}, {row['started'][:10]}" for row in chosen.rows]
        wanted = [(result, word) for result in tests.first.progress.results if line in (0, result.number)
                  for word in tests.words]
        for result, word in wanted[:_MAX_CHARTS]:
            found = trend([tests.distance(test, result.number, word) for test in range(len(names))], baseline)
            beyond = ", ".join(names[index] for index in found.beyond)
            said = found.reason or f"Beyond the limits: {beyond or 'none'}"
            charts.append({"name": line_name(tests.first.scenario, result), "word": word,
                           "picture": trend_picture(found, names),
                           "said": f"{said} {found.unlike}".rstrip()})
        return charts

    def _kept(self, files: list[dict[str, Any]]) -> frozenset[str]:
        if self._files is None:
            return frozenset()
        return frozenset(file["sha256"] for file in files if self._files.path_of(file["sha256"]).is_file())


def _number(query: Mapping[str, str], name: str) -> int:
    """Return 0 for a text that is not a number."""
    text = query.get(name, "")
    return int(text) if text.isascii() and text.isdecimal() and len(text) < 10 else 0


def _address(kept: Mapping[str, str], offset: int) -> str:
    return "/?" + urlencode({**kept, "from": max(0, offset)})
