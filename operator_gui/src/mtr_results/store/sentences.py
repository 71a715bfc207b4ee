"""Database errors as sentences for a person, with instructions."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
from typing import Iterator

from sqlalchemy.exc import DBAPIError, IntegrityError, InterfaceError, OperationalError

from ..errors import StoreAway, StoreError

# Part of a database message in lower case -> reason why the store cannot be used.
_AWAY = (
    ("database is locked", "another program has been writing to it for too long; try again when that has ended"),
    ("disk is full", "its disk is full; make room"),
    ("no space left", "its disk is full; make room"),
    ("unable to open", "its file cannot be opened; look for the folder and its rights"),
    ("readonly", "its file may not be written; look for its rights"),
    ("disk i/o error", "its disk is full, or has errors; make room, and look at the disk"),
    ("can't create a connection", "no database server answers there; look whether it runs, and at the address"),
    ("network error", "the connection to the database server broke"),
)
_WRONG = (
    ("not a database", "the file is none of a store"),
    ("malformed", "its file is damaged; take the last copy of it"),
    ("password authentication failed", "the database server refuses this user or password"),
    ("does not exist", "there is no such database or user on the server"),
)
_MAX_SHOWN = 200


@contextlib.contextmanager
def told(where: str) -> Iterator[None]:
    """Context that converts database failures to StoreError, and to StoreAway if a later attempt may succeed.

    where: address of the store without a password. A constraint violation is passed on to the writer.
    """
    try:
        yield
    except IntegrityError:
        raise
    except DBAPIError as error:
        raise _error(where, error) from None


def _error(where: str, error: DBAPIError) -> StoreError:
    said = " ".join(str(error.orig).split())
    for words, meaning in _AWAY:
        if words in said.lower():
            return StoreAway(f"The store {where} is away: {meaning}.")
    for words, meaning in _WRONG:
        if words in said.lower():
            return StoreError(f"The store {where} cannot be used: {meaning}.")
    kind = StoreAway if isinstance(error, (OperationalError, InterfaceError)) else StoreError
    return kind(f"The store {where} failed: {said[:_MAX_SHOWN]}")
