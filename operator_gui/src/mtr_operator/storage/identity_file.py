"""Files that a person writes of a test's identity: of one test, and of the laboratory."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Any, Callable, NamedTuple, TypeVar

from mtr_operator.domain.errors import InvalidIdentity
from mtr_operator.domain.identity.identity import MAX_PHOTOS, NOBODY, Identity
from mtr_operator.domain.identity.identity_document import identity_from
from mtr_operator.domain.identity.laboratory import Laboratory, laboratory_from

from .plain_yaml import BadYaml, load_yaml

Content = TypeVar("Content")
# Beside the settings.
LABORATORY_NAME = "laboratory.yaml"


class GivenIdentity(NamedTuple):
    """What is said of a test before it starts. photos: files that are to be kept beside its record."""

    identity: Identity = NOBODY
    photos: tuple[pathlib.Path, ...] = ()


def load_identity(path: pathlib.Path) -> GivenIdentity:
    """Identity in a file, in which photos are paths that may be relative to it; InvalidIdentity says what is wrong."""
    return _load(path, lambda document: _given(document, path.parent))


def load_laboratory(path: pathlib.Path) -> Laboratory:
    """The laboratory's wishes; none where there is no such file. InvalidIdentity says what is wrong with it."""
    return _load(path, laboratory_from) if path.exists() else Laboratory()


def _given(document: Any, folder: pathlib.Path) -> GivenIdentity:
    if document is None:
        return GivenIdentity()
    if not isinstance(document, dict):
        return GivenIdentity(identity_from(document))
    names = document.get("photos") or []
    if not isinstance(names, list) or len(names) > MAX_PHOTOS or not all(isinstance(name, str) for name in names):
        raise InvalidIdentity(f"photos has to be a list of at most {MAX_PHOTOS} paths.")
    identity = identity_from({name: value for name, value in document.items() if name != "photos"})
    return GivenIdentity(identity, tuple(folder / name for name in names))


def _load(path: pathlib.Path, read: Callable[[Any], Content]) -> Content:
    try:
        document = load_yaml(path)
    except OSError as error:
        raise InvalidIdentity(f"The file {path} cannot be read: {error.strerror or error}.") from None
    except BadYaml as error:
        raise InvalidIdentity(f"The file {path} {error}.") from None
    try:
        return read(document)
    except InvalidIdentity as error:
        raise InvalidIdentity(f"In the file {path}: {error}") from None
