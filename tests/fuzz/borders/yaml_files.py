"""Files that persons write: parameters, limits, profiles, identity, the laboratory, calibrations, the list of keys."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import datetime
import math
import pathlib
import random
import shutil
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Tuple

from spoiling import spoilt_text

from mtr_dispatcher.access.authorised_keys import KeysError, keys_in
from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.calibration_file import new_record, save_calibration
from mtr_operator.storage.given_files import DEFAULT_CALIBRATION, load_calibration, load_limits
from mtr_operator.storage.identity_file import load_identity, load_laboratory
from mtr_operator.storage.parameter_file import load_parameters

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "operator_gui" / "examples"
KEYS = "keys:\n" + "".join(f"- name: {name}\n  role: {role}\n  date: '2026-11-23'\n  key: '{key * 40}'\n"
                           for name, role, key in (("Jana", "controller", "a"), ("Eva", "viewer", "b")))
MAX_SENTENCE = 2000


class Kind(NamedTuple):
    """One kind of file: good texts, how it is read, and what is raised for a bad one."""

    texts: List[str]
    load: Callable[[pathlib.Path], Any]


def prepare(folder: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border; folder: for its files."""
    kinds = _kinds(folder)
    for database in PROFILE_FOLDER.glob("*.dbc"):
        shutil.copy(database, folder)

    def case(chance: random.Random) -> Tuple[str, str]:
        kind = kinds[chance.choice(sorted(kinds))]
        path = folder / "case.yaml"
        path.write_bytes(spoilt_text(chance, chance.choice(kind.texts)).encode("utf-8", "surrogateescape"))
        try:
            found = kind.load(path)
        except (OperatorError, KeysError) as error:
            said = str(error)
            return "refused", "" if 10 < len(said) < MAX_SENTENCE else f"a sentence of {len(said)}: {said[:200]}"
        wrong = [number for number in numbers_in(found) if not math.isfinite(number)]
        return "taken", f"{wrong} in {found}"[:500] if wrong else ""
    return case


def numbers_in(value: Any) -> Iterator[float]:
    """All floating-point numbers of an object that a file has become."""
    if isinstance(value, float):
        yield value
    elif dataclasses.is_dataclass(value) and not isinstance(value, type):
        for field in dataclasses.fields(value):
            # Of a figure that nobody doubts they are infinite.
            if field.name == "degrees_of_freedom" and value.degrees_of_freedom == math.inf:
                continue
            yield from numbers_in(getattr(value, field.name))
    elif isinstance(value, dict):
        for each in value.values():
            yield from numbers_in(each)
    elif isinstance(value, (list, tuple)):
        for each in value:
            yield from numbers_in(each)


def _kinds(folder: pathlib.Path) -> Dict[str, Kind]:
    texts = {name: [path.read_text(encoding="utf-8") for path in sorted(EXAMPLES.glob(pattern))]
             for name, pattern in (("limits", "limits/*.yaml"), ("identity", "identity/my_test.yaml"),
                                   ("laboratory", "identity/laboratory.yaml"))}
    record = folder / "record.yaml"
    save_calibration(record, new_record("jackal-1", "Jana", datetime.date(2026, 11, 23)))
    found = {
        "limits": Kind(texts["limits"], load_limits), "identity": Kind(texts["identity"], load_identity),
        "laboratory": Kind(texts["laboratory"], load_laboratory),
        "calibration": Kind([DEFAULT_CALIBRATION.read_text(encoding="utf-8"), record.read_text(encoding="utf-8")],
                            load_calibration),
        "profile": Kind([path.read_text(encoding="utf-8") for path in sorted(PROFILE_FOLDER.glob("*.yaml"))],
                        lambda path: load_profile(str(path))),
        "keys": Kind([KEYS], lambda path: keys_in(path.read_text(encoding="utf-8", errors="replace")))}
    for name, scenario in SCENARIOS.items():
        files = [*EXAMPLES.glob(f"**/{name}.yaml")]
        found[name] = Kind([path.read_text(encoding="utf-8") for path in sorted(files) if path.parent.name != "limits"],
                           lambda path, kind=scenario.parameters_type: load_parameters(path, kind))
    return found
