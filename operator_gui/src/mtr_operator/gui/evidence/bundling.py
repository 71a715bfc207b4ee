"""Writes the bundle of a test that the window shows."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Callable, Mapping, NamedTuple

from mtr_operator.domain.results.session_record import CAR_PROFILE
from mtr_operator.evidence.bundle import BundleWatch, bundle_path, write_bundle
from mtr_operator.station.test import Test

from ..pictures.protocol_picture import Protocol


class Bundled(NamedTuple):
    """number: in the chain of the station, which signed it. left_out: why, by the name of what is missing."""

    number: int
    station: str
    left_out: Mapping[str, str]


class _Watch(BundleWatch):
    """Keeps what is left out, and hands on how much is done."""

    def __init__(self, done: Callable[[float], None]):
        self.missing: dict[str, str] = {}
        self._done = done

    def left_out(self, name: str, reason: str) -> None:
        """See BundleWatch."""
        self.missing[name] = reason

    def done(self, share: float) -> None:
        """See BundleWatch."""
        self._done(share)


def bundle(protocol: Protocol, test: Test, folder: pathlib.Path,
           done: Callable[[float], None]) -> tuple[pathlib.Path, Bundled]:
    """Write it into the folder of the report, which is there; OperatorError when that fails. done: see BundleWatch."""
    target, watch = folder / bundle_path(test.path).name, _Watch(done)
    progress = protocol.progress
    manifest = write_bundle(target, test.path, protocol.scenario, progress, protocol.assessment,
                            profile=progress.session.get(CAR_PROFILE, ""), watch=watch)
    return target, Bundled(manifest.number, manifest.station, watch.missing)
