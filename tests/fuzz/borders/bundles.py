"""Bundles of somebody: intact is only what was signed, byte by byte; whatever else it is has a sentence."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import random
import shutil
import zipfile
from typing import Callable, Dict, Tuple

from spoiling import spoilt_bytes, spoilt_text

from mtr_operator.evidence.bundle import write_bundle
from mtr_operator.evidence.station_key import Station
from mtr_operator.evidence.verification import chain_problems, is_newer, verify_bundle
from mtr_operator.station.test import open_test

WRITTEN_BEFORE = pathlib.Path(__file__).resolve().parents[3] / "operator_gui" / "tests" / "unit" / "written_before"


def prepare(folder: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border; folder: for its files."""
    test = folder / "test" / "progress.json"
    shutil.copytree(WRITTEN_BEFORE / "autolock", test.parent)
    bundle, opened = folder / "good.mtr.zip", open_test(test)
    write_bundle(bundle, test, opened.scenario, opened.progress, None, profile="mtr_demo_car",
                 station=Station(folder / "station"))
    good = bundle.read_bytes()
    with zipfile.ZipFile(bundle) as container:
        members = {name: container.read(name) for name in container.namelist()}
    intact = verify_bundle(bundle)
    assert intact.is_intact

    def case(chance: random.Random) -> Tuple[str, str]:
        path = folder / "case.mtr.zip"
        if chance.random() < 0.5:
            path.write_bytes(spoilt_bytes(chance, good))
        else:
            rewritten(path, chance, members)
        found = verify_bundle(path)
        is_newer(path)
        chain_problems([found, intact])
        if found.is_intact:
            return "intact", "" if path.read_bytes() == good else f"changed, case in {path}"
        return "refused", "" if found.problems and all(each.endswith(".") for each in found.problems) else "no sentence"
    return case


def rewritten(path: pathlib.Path, chance: random.Random, members: Dict[str, bytes]) -> None:
    """A good container of files of which one is changed: its check sum is right, its signature is not."""
    changed = dict(members)
    name = chance.choice(sorted(members))
    kind = chance.randrange(4)
    if kind == 0:
        del changed[name]
    elif kind == 1:
        changed[chance.choice(("../evil", "/etc/passwd", "a" * 300, "progress.json/x"))] = b"x"
    elif name.endswith(".json"):
        changed[name] = spoilt_text(chance, changed[name].decode("utf-8")).encode("utf-8", "surrogateescape")
    else:
        changed[name] = spoilt_bytes(chance, changed[name])
    if kind == 3 and "manifest.json" in changed:
        changed["manifest.json"] = json.dumps(chance.choice(
            ({}, [], {"format": 1}, json.loads(members["manifest.json"]) | {"version": 10 ** 400}))).encode()
    # Of a compressed one nothing is read.
    packing = zipfile.ZIP_STORED if chance.randrange(20) else zipfile.ZIP_DEFLATED
    with zipfile.ZipFile(path, "w", packing) as container:
        for each, content in changed.items():
            container.writestr(each, content)
