"""CAN databases (DBC) of a profile: refused with a sentence, or usable."""
# SPDX-License-Identifier: Apache-2.0
import copy
import pathlib
import random
from typing import Callable, Tuple

from spoiling import spoilt_text

from mtr_operator.car_link import profile as profiles
from mtr_operator.car_link.profile import PROFILE_FOLDER, load_profile
from mtr_operator.domain.errors import OperatorError


def prepare(folder: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border; folder: for its files."""
    texts = {path.stem: path.read_text(encoding="latin-1") for path in PROFILE_FOLDER.glob("*.dbc")}
    for name in texts:
        (folder / f"{name}.yaml").write_bytes((PROFILE_FOLDER / f"{name}.yaml").read_bytes())
    # The good profiles beside them are read once: YAML is a border of its own, and took more than half of the time.
    good = {folder / f"{name}.yaml": profiles.load_yaml(folder / f"{name}.yaml") for name in texts}
    profiles.load_yaml = lambda path: copy.deepcopy(good[path])

    def case(chance: random.Random) -> Tuple[str, str]:
        name = chance.choice(sorted(texts))
        (folder / f"{name}.dbc").write_bytes(spoilt_text(chance, texts[name]).encode("latin-1", "replace"))
        try:
            profile = load_profile(str(folder / f"{name}.yaml"))
        except OperatorError as error:
            return "refused", "" if 10 < len(str(error)) < 2000 else f"a sentence of {len(str(error))}"
        for size in (0, 1, 7, 8, 64):
            profile.decode(profile.message.frame_id, profile.message.is_extended_frame, b"\xff" * size)
        return "taken", "" if profile.states else "a Car without states"
    return case
