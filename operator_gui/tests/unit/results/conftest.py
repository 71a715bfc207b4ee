"""Fixtures of empty stores: an SQLite file, and a database of a real PostgreSQL server."""
# SPDX-License-Identifier: Apache-2.0
import itertools

import postgresql
import pytest
import sqlalchemy

from mtr_results.store.database import engine_of
from mtr_results.store.place import Place

NUMBERS = itertools.count(1)


@pytest.fixture(scope="session")
def server():
    """Start one PostgreSQL server for all tests that need it."""
    with postgresql.server() as url:
        yield url


@pytest.fixture
def postgresql_address(server):
    """Return the address of an empty database."""
    name = f"store{next(NUMBERS)}"
    engine = engine_of(server.format("postgres"))
    with engine.connect().execution_options(isolation_level="AUTOCOMMIT") as connection:
        connection.execute(sqlalchemy.text(f"CREATE DATABASE {name}"))
    engine.dispose()
    return server.format(name)


@pytest.fixture
def place(tmp_path):
    """Return an empty SQLite store."""
    return Place(str(tmp_path / "store.sqlite"), spool=tmp_path / "spool")


@pytest.fixture(params=["sqlite", "postgresql"])
def any_place(request, place, tmp_path):
    """Return an empty store on each kind of database."""
    if request.param == "sqlite":
        return place
    return Place(request.getfixturevalue("postgresql_address"), tmp_path / "files", tmp_path / "spool")
