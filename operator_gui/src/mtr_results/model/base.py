"""Base class of all tables."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from sqlalchemy import MetaData
from sqlalchemy.orm import DeclarativeBase

# Named constraints can be changed by a migration on any database.
NAMES = {"ix": "ix_%(table_name)s_%(column_0_name)s", "uq": "uq_%(table_name)s", "pk": "pk_%(table_name)s",
         "fk": "fk_%(table_name)s_%(column_0_name)s_%(referred_table_name)s"}


class Base(DeclarativeBase):
    """Base of all tables of the store."""

    metadata = MetaData(naming_convention=NAMES)
