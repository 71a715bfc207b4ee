"""Bundles: a test with all its evidence in one signed file, which is verified before it is read."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import pathlib
import tempfile
import zipfile
from typing import Collection, Iterator

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.storage.progress_file import FILE_NAME

from ..errors import StoreAway, StoreError


@contextlib.contextmanager
def unpacked(path: pathlib.Path, stations: Collection[str] = ()) -> Iterator[pathlib.Path]:
    """Context with a folder of the unpacked files of a bundle; see source.opened."""
    _verify(path, stations)
    from mtr_operator.evidence.container import unpack
    with tempfile.TemporaryDirectory(prefix="mtr_bundle_") as folder:
        try:
            with zipfile.ZipFile(path) as container:
                unpack(container, pathlib.Path(folder))
        except OSError as error:
            raise StoreAway(f"The bundle {path} cannot be unpacked into {folder}: "
                            f"{error.strerror or error}.") from None
        place = pathlib.Path(folder)
        if not (place / FILE_NAME).is_file():
            raise StoreError(f"The bundle {path} holds no {FILE_NAME}; import the folder of the test.")
        try:
            yield place
        except ProgressFileError as error:
            # The temporary folder no longer exists when the message is shown, so the message names the bundle.
            raise ProgressFileError(str(error).replace(str(place / FILE_NAME), str(path))) from None


def _verify(path: pathlib.Path, stations: Collection[str]) -> None:
    # Requires a package that only bundles need.
    from mtr_operator.evidence.verification import is_newer, verify_bundle
    found = verify_bundle(path)
    if found.manifest is None and is_newer(path):
        raise StoreError(f"The bundle {path} was written by a newer version of the application; import it with that "
                         "version.")
    if not found.is_intact or found.manifest is None:
        raise StoreError(f"The bundle {path} is not as it was signed. {' '.join(found.problems)}")
    if stations and found.manifest.key not in stations:
        raise StoreError(f"The bundle {path} was signed by the station {found.manifest.station} with the key "
                         f"{found.manifest.key}, which is none of those that are believed; name it with --station when "
                         "it is one of yours.")
