"""CAN databases of the other kinds (KCD, SYM, ARXML): refused with a sentence, or usable."""
# SPDX-License-Identifier: Apache-2.0
import importlib
import pathlib
import random
import sys
from typing import Callable, Tuple

from spoiling import spoilt_text

from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.errors import OperatorError

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "operator_gui" / "tests" / "support"))
made = importlib.import_module("database_kinds")

FRAMES = [made.Frame("DOORS", 0x123, [("LOCK", 0, 2), ("WINDOW", 8, 16)]),
          made.Frame("LIGHTS", 0x124, [("BEAM", 4, 12)])]
KINDS = {".kcd": made.kcd(FRAMES), ".sym": made.sym(FRAMES), ".arxml": made.arxml(FRAMES)}


def prepare(folder: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border; folder: for its files."""
    def case(chance: random.Random) -> Tuple[str, str]:
        suffix = chance.choice(sorted(KINDS))
        text = spoilt_text(chance, KINDS[suffix]).encode("utf-8", "surrogateescape").decode("latin-1")
        path = made.written(folder, suffix, text)
        try:
            profile = load_profile(path)
        except OperatorError as error:
            return "refused", "" if 10 < len(str(error)) < 2000 else f"{suffix}: a sentence of {len(str(error))}"
        for size in (0, 1, 7, 8, 64):
            profile.decode(profile.message.frame_id, profile.message.is_extended_frame, b"\xff" * size)
        return "taken", "" if profile.states else f"{suffix}: a Car without states"
    return case
