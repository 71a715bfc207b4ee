"""Compares our poses and MRPT's with the truth of one recording, if it has one."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import tempfile
from typing import Any, Dict, List, NamedTuple, Optional

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_localization.any_bag.errors import BagUnusable
from mtr_localization.any_bag.sources import Asked

from ..localization.drives.pose_track import PoseTrack
from ..localization.drives.sensor_log import read_sensors
from ..localization.methods.mrpt import run_mrpt
from .halves import Halves, halves_of, localized, truth_in
from .truth_fit import errors_m, fit

MM_PER_M = 1e3


class Off(NamedTuple):
    """Position errors of one method in mm, in the part of the truth that is not used for the fit."""

    rms_mm: float
    p95_mm: float
    places: int


class Outcome(NamedTuple):
    """Result of one recording.

    Attributes:
        refused: reason for which it cannot be used; empty: it can.
        valid_share: share of valid poses on the map of the other half.
        ours, mrpt: None without truth, and without MRPT.
    """

    bag: str
    refused: str = ""
    valid_share: Optional[float] = None
    cpu_ms_per_scan: Optional[float] = None
    ours: Optional[Off] = None
    mrpt: Optional[Off] = None
    said: List[str] = []

    def document(self) -> Dict[str, Any]:
        """Return the result as plain values."""
        return {name: value._asdict() if isinstance(value, Off) else value for name, value in self._asdict().items()}


def measure(bag: pathlib.Path, truth_topic: str, mrpt: Optional[pathlib.Path], asked: Asked) -> Outcome:
    """Map with the even sweeps and localize with the odd ones; the result of an unusable bag has the reason."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        try:
            halves = halves_of(bag, folder, asked)
            mapped = localized(halves.even, folder / "map", halves.found)
            if not (folder / "map" / "map.bag").exists():
                return Outcome(bag.name, " ".join(mapped.messages) or "No map came of it.", said=halves.found.said)
            place = [f"{value:.9f}" for value in mapped.track.poses[0]]
            found = localized(halves.odd, folder / "odd", halves.found, "--map", str(folder / "map" / "map.bag"),
                              "--begin-at", *place)
        except (BagUnusable, RuntimeError) as error:
            return Outcome(bag.name, str(error))
        stamps_s, positions = truth_in(bag, truth_topic)
        ours = rival = None
        if len(stamps_s) and len(found.track.stamps_s):
            ours = off(mapped.track, found.track, stamps_s, positions)
            rival = None if mrpt is None else _of_mrpt(mrpt, halves, folder, stamps_s, positions)
        if not len(found.track.stamps_s):
            return Outcome(bag.name, " ".join(found.messages), said=halves.found.said)
        return Outcome(bag.name, "", found.valid_share, found.cpu_ms_per_scan, ours, rival, halves.found.said)


def off(fitted: PoseTrack, scored: PoseTrack, stamps_s: FloatArray, positions: FloatArray) -> Optional[Off]:
    """Fit every second position of the truth to one track, and return the errors of another track at the positions
    between.

    The result is None if there are too few positions.
    """
    try:
        found = fit(fitted, stamps_s[::2], positions[::2])
    except ValueError:
        return None
    off_mm = MM_PER_M * errors_m(found, scored, stamps_s[1::2], positions[1::2])
    return Off(float(np.sqrt(np.mean(off_mm ** 2))), float(np.percentile(off_mm, 95.0)), len(off_mm))


def _of_mrpt(program: pathlib.Path, halves: Halves, folder: pathlib.Path, stamps_s: FloatArray,
             positions: FloatArray) -> Optional[Off]:
    """Run MRPT, which maps continuously, on every second sweep: the same number as our map has."""
    run = run_mrpt(program, read_sensors(halves.whole, halves.mounts), halves.odometry, folder)
    return off(run.track, run.track, stamps_s, positions)


