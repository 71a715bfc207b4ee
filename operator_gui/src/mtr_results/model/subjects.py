"""Tested objects and equipment: cars, keys, equipment, campaigns. Each has one row, shared by all its tests."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from sqlalchemy import ForeignKey, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from .base import Base


class Campaign(Base):
    """Tests that belong together, under a name chosen by a person."""

    __tablename__ = "campaign"
    id: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str] = mapped_column(unique=True)


class Car(Base):
    """A Car with its software; the same Car after an update is another row. Unspecified fields are empty."""

    __tablename__ = "car"
    __table_args__ = (UniqueConstraint("vin", "model", "software"),)
    id: Mapped[int] = mapped_column(primary_key=True)
    vin: Mapped[str]
    model: Mapped[str]
    software: Mapped[str]


class Key(Base):
    """A Remote key."""

    __tablename__ = "key"
    __table_args__ = (UniqueConstraint("serial", "type"),)
    id: Mapped[int] = mapped_column(primary_key=True)
    serial: Mapped[str]
    type: Mapped[str]


class Equipment(Base):
    """An instrument with its calibration at the time of the test; days are ISO dates, or empty."""

    __tablename__ = "equipment"
    __table_args__ = (UniqueConstraint("name", "serial", "calibrated", "valid_until"),)
    id: Mapped[int] = mapped_column(primary_key=True)
    name: Mapped[str]
    serial: Mapped[str]
    calibrated: Mapped[str]
    valid_until: Mapped[str]


class TestEquipment(Base):
    """Assignment of instruments to tests."""

    __tablename__ = "test_equipment"
    __table_args__ = {"sqlite_with_rowid": False}
    test_id: Mapped[int] = mapped_column(ForeignKey("test.id", ondelete="CASCADE"), primary_key=True)
    equipment_id: Mapped[int] = mapped_column(ForeignKey("equipment.id"), primary_key=True)
