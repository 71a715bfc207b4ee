"""Paths of files that documents name: inside the folder that is meant, or refused."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib

from mtr_operator.domain.errors import UnsafeName
from mtr_operator.domain.identity.file_name import SEPARATED, name_problem, shown


def inside(folder: pathlib.Path, name: object) -> pathlib.Path:
    """Path of the file with this plain name in a folder; UnsafeName for a name that leads anywhere else.

    Also refuses a name that is there as a symbolic link to another folder.
    """
    problem = name_problem(name)
    if problem or not isinstance(name, str):
        raise UnsafeName(f"The file name {shown(name)} is refused. {problem}.")
    path = folder / name
    if not stays_inside(folder, path):
        raise UnsafeName(f"The file name {shown(name)} is refused. It is a link that leads out of {folder}.")
    return path


def below(folder: pathlib.Path, name: object) -> pathlib.Path:
    """As inside(), for a name that may have folders of its own, separated by "/"."""
    parts: list[object] = [*name.split("/")] if isinstance(name, str) else [name]
    if "" in parts:
        raise UnsafeName(f"The file name {shown(name)} is refused. {SEPARATED}.")
    for part in parts:
        folder = inside(folder, part)
    return folder


def stays_inside(folder: pathlib.Path, path: pathlib.Path) -> bool:
    """True when a path directly in a folder is no link to another folder."""
    try:
        return path.resolve().parent == folder.resolve()
    # Links in a circle are a RuntimeError before Python 3.13.
    except (OSError, RuntimeError, ValueError):
        return False
