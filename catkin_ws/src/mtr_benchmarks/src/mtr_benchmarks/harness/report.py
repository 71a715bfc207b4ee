"""Output of a benchmark: a JSON file with figures and table, printed lines, and an exit status."""
# SPDX-License-Identifier: Apache-2.0
import json
import math
import pathlib
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping

from .lines import line
from .rows import Row, all_met


@dataclass(frozen=True)
class BenchmarkReport:
    """Results of one benchmark.

    Attributes:
        rows: rows of the table.
        figures: all other content of the file, by its top-level key.
        remarks: sentences below the table.
    """

    rows: List[Row]
    figures: Mapping[str, Any]
    remarks: List[str] = field(default_factory=list)

    def document(self) -> Dict[str, Any]:
        """Return the content of the file; the table is its last key."""
        return {**{key: _finite(value) for key, value in self.figures.items()},
                "table": [row.as_json() for row in self.rows]}


def write(report: BenchmarkReport, path: pathlib.Path) -> None:
    """Write the file; create its folder if necessary."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(report.document(), indent=2, allow_nan=False) + "\n", encoding="utf-8")


def finish(report: BenchmarkReport, path: pathlib.Path) -> int:
    """Write the file and print the table; return the exit status, 0 if every row meets its requirement."""
    write(report, path)
    print("\n".join([*map(line, report.rows), *report.remarks]), flush=True)
    return 0 if all_met(report.rows) else 1


def _finite(value: Any) -> Any:
    """Return the value with None in place of non-finite numbers, which JSON does not support."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(each) for each in value]
    return value
