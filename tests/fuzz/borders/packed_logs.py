"""Logs of a CAN bus packed with gzip, and MF4 where asammdf is installed: read, or refused with a sentence."""
# SPDX-License-Identifier: Apache-2.0
import gzip
import importlib.util
import pathlib
import random
import warnings
from typing import Callable, Tuple

from spoiling import spoilt_bytes, spoilt_text

from .bus_logs import TEXTS, outcome, whole_log

MF4 = "mf4"


def prepare(folder: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border; folder: for its files."""
    warnings.simplefilter("ignore")
    whole = {kind: whole_log(folder / f"whole.{kind}") for kind in TEXTS}
    if importlib.util.find_spec("asammdf"):
        whole[MF4] = whole_log(folder / f"whole.{MF4}")

    def case(chance: random.Random) -> Tuple[str, str]:
        kind = chance.choice(sorted(whole))
        path = folder / (f"case.{kind}" if kind == MF4 else f"case.{kind}.gz")
        path.write_bytes(spoilt_bytes(chance, whole[kind]) if kind == MF4 else _packed(chance, whole[kind]))
        return outcome(path)
    return case


def _packed(chance: random.Random, text: bytes) -> bytes:
    """Spoilt before it is packed, after it, or both."""
    if chance.random() < 0.4:
        text = spoilt_text(chance, text.decode("utf-8")).encode("utf-8", "surrogateescape")
    packed = gzip.compress(text, mtime=0)
    return spoilt_bytes(chance, packed) if chance.random() < 0.8 else packed
