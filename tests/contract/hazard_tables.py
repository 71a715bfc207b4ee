"""The tables of `docs/safety/README.md` and `docs/safe-operation.md`, made from the hazard file.

`python tests/contract/hazard_tables.py` writes them into the pages.
"""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import Callable, Dict, Iterator, List, Sequence

import stopping_distances as stopping
from hazard_file import TOP, Hazard, HazardFile, Measure, read

PAGE = TOP / "docs" / "safety" / "README.md"
OPERATION = TOP / "docs" / "safe-operation.md"
Row = Sequence[str]


def begin(name: str) -> str:
    """Line above a table."""
    return f"<!-- {name}: begin -->"


def end(name: str) -> str:
    """Line below it."""
    return f"<!-- {name}: end -->"


def tables() -> Dict[pathlib.Path, Dict[str, Callable[[HazardFile], List[str]]]]:
    """Tables of each page by their name."""
    return {PAGE: {"hazard summary": summary, "site released": released, "functions": functions,
                   "stopping distances": stopping_distances, "hazards": hazards, "measures": measures},
            OPERATION: {"site limits": site_limits}}


def written(page: pathlib.Path, name: str) -> List[str]:
    """Lines of a table in its page."""
    return page.read_text(encoding="utf-8").partition(begin(name))[2].partition(end(name))[0].strip().splitlines()


def write(file: HazardFile) -> None:
    """Replace all tables of all pages."""
    for page, makers in tables().items():
        text = page.read_text(encoding="utf-8")
        for name, made in makers.items():
            head, _, rest = text.partition(begin(name))
            text = "\n".join([head + begin(name), *made(file), end(name) + rest.partition(end(name))[2]])
        page.write_text(text, encoding="utf-8")


def _table(head: Row, rows: Iterator[Row]) -> List[str]:
    return [f"| {' | '.join(head)} |", "|---" * len(head) + "|", *(f"| {' | '.join(row)} |" for row in rows)]


def _joined(names: Sequence[str]) -> str:
    return ", ".join(names) or "-"


def summary(file: HazardFile) -> List[str]:
    """Numbers of hazards by required level, and of those without a proof."""
    found = {level: [each for each in file.hazards if each.risk.level == level] for level in "abcde"}
    return _table(("PLr", "Hazards", "Without a proof"), (
        (level, str(len(each)), _joined([one.id for one in each if not one.is_proved]))
        for level, each in found.items() if each))


def released(file: HazardFile) -> List[str]:
    """Hazards that keep a site from being released."""
    rows = ((each.id, each.title, each.residual.risk.level, each.residual.reason) for each in file.hazards
            if not each.residual.sites)
    return _table(("id", "Hazard", "Residual", "Reason"), rows)


def functions(file: HazardFile) -> List[str]:
    """Functions on which measures rely, with the level that is required and the one that is claimed."""
    return _table(("id", "Function", "Attended", "Shared", "Unattended", "Implemented by", "Claim"), (
        (name, each["name"], *(each["plr"][site] for site in ("attended", "shared", "unattended")), each["by"],
         each["claim"]) for name, each in file.functions.items()))


def stopping_distances(_file: HazardFile) -> List[str]:
    """Distances by the event that begins the stop and by the speed."""
    columns = stopping.columns()
    words = {stopping.LOW_M: "low", stopping.RAISED_M: "raised"}
    head = [f"{speed_mps:.2f} m/s, {words[height_m]}" for speed_mps, height_m in columns]
    return _table(("Stop after", *head), (
        (name, *(f"{stopping.distance_m(speed_mps, stopping.delays_s(speed_mps)[name], height_m):.2f} m"
                 for speed_mps, height_m in columns)) for name in stopping.delays_s(0.0)))


def hazards(file: HazardFile) -> List[str]:
    """One row for each hazard."""
    head = ("id", "Hazard", "Losses", "S/E/A", "PLr", "Functions", "Done", "Open", "Evidence", "Remaining risk")
    return _table(head, (_hazard(each) for each in file.hazards))


def _hazard(hazard: Hazard) -> Row:
    return (hazard.id, hazard.title, _joined(hazard.losses), str(hazard.risk), hazard.risk.level,
            _joined(hazard.functions), *(_joined(_ids(hazard, status)) for status in ("done", "open")), hazard.evidence,
            hazard.left)


def _ids(hazard: Hazard, status: str) -> List[str]:
    return [measure.id for measure in hazard.measures if measure.status == status]


def measures(file: HazardFile) -> List[str]:
    """One row for each measure."""
    return _table(("id", "Measure", "Type", "Status", "Where", "Parameters", "Proofs"), (
        _measure(each) for hazard in file.hazards for each in hazard.measures))


def _measure(measure: Measure) -> Row:
    values = [f"`{name}` {value}" for name, value in measure.parameters.items()]
    return (measure.id, measure.what, measure.type, measure.status, f"`{measure.where}`" if measure.where else "-",
            _joined(values), "<br>".join(f"`{proof}`" for proof in measure.proofs) or "-")


def site_limits(file: HazardFile) -> List[str]:
    """Operating conditions with their reasons."""
    return _table(("Condition", "Limit", "Reason"), ((name.capitalize(), each["limit"], each["reason"])
                                                      for name, each in file.odd.items()))


if __name__ == "__main__":
    write(read())
