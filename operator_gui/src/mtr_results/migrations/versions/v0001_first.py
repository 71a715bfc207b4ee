"""Initial tables."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None


def upgrade() -> None:
    """Create all tables."""
    _make_subjects()
    _make_test()
    _make_parts()


def downgrade() -> None:
    """Remove all tables."""
    for table in ("trial", "measurement", "verdict", "test_equipment", "line", "file", "test"):
        op.drop_table(table)
    for table in ("key", "equipment", "car", "campaign"):
        op.drop_table(table)


def _make_subjects() -> None:
    for table, names in (("campaign", ("name",)), ("car", ("vin", "model", "software")), ("key", ("serial", "type")),
                         ("equipment", ("name", "serial", "calibrated", "valid_until"))):
        op.create_table(table, sa.Column("id", sa.Integer(), nullable=False), *map(_text, names),
                        sa.PrimaryKeyConstraint("id", name=f"pk_{table}"),
                        sa.UniqueConstraint(*names, name=f"uq_{table}"))


def _make_test() -> None:
    op.create_table(
        "test", sa.Column("id", sa.Integer(), nullable=False), _text("test_key"), _whole("entries"),
        _flag("has_journal"), _text("digest"), sa.Column("campaign_id", sa.Integer()),
        _whole("car_id"), _whole("key_id"),
        *map(_text, ("scenario", "started", "started_utc", "imported_utc", "operator", "place", "weather", "notes")),
        _number("key_battery_v"), *map(_text, ("car_profile", "robot", "software", "robot_software")),
        *map(_number, ("car_length_m", "car_width_m")), *map(_whole, ("done", "total", "invalid")),
        _flag("is_complete"), *map(_text, ("verdict", "words")),
        sa.Column("document", sa.LargeBinary(), nullable=False),
        *(sa.ForeignKeyConstraint([f"{table}_id"], [f"{table}.id"], name=f"fk_test_{table}_id_{table}")
          for table in ("campaign", "car", "key")),
        sa.PrimaryKeyConstraint("id", name="pk_test"), sa.UniqueConstraint("test_key", name="uq_test"))
    for column in ("campaign_id", "car_id", "key_id", "scenario", "started_utc", "verdict"):
        op.create_index(f"ix_test_{column}", "test", [column])


def _make_parts() -> None:
    _of_test("file", ("name",), _text("name"), _text("sha256"), _whole("size"))
    _of_test("line", ("number",), _whole("number"), _text("place"),
             *(sa.Column(name, sa.Float(), nullable=False)
               for name in ("origin_x_m", "origin_y_m", "direction_x", "direction_y")),
             _number("height_m"), _text("reason"), _text("holes_m"))
    _of_test("test_equipment", ("equipment_id",), _whole("equipment_id"),
             sa.ForeignKeyConstraint(["equipment_id"], ["equipment.id"],
                                     name="fk_test_equipment_equipment_id_equipment"))
    _of_test("verdict", ("number",), _whole("number"), _whole("line"),
             *map(_text, ("requirement", "verdict", "reason")))
    _of_line("measurement", ("word", "revision"), _text("word"), _whole("revision"), _flag("is_current"),
             _text("status"), _text("kind"), *map(_number, ("first_m", "second_m", "sigma_m")), _flag("has_interval"),
             *map(_number, ("low_m", "high_m", "own_sigma_m", "common_sigma_m", "expanded_m", "coverage",
                            "coverage_low", "coverage_high")))
    _of_line("trial", ("number",), _whole("number"), _whole("attempt"), _text("word"), _text("status"),
             *map(_number, ("distance_m", "sigma_m", "x_m", "y_m", "height_m", "speed_mps", "robot_time_s")),
             _text("cause"))


def _of_test(table: str, key: tuple[str, ...], *columns: sa.schema.SchemaItem) -> None:
    op.create_table(table, _whole("test_id"), *columns,
                    sa.ForeignKeyConstraint(["test_id"], ["test.id"], name=f"fk_{table}_test_id_test",
                                            ondelete="CASCADE"),
                    sa.PrimaryKeyConstraint("test_id", *key, name=f"pk_{table}"), sqlite_with_rowid=False)


def _of_line(table: str, key: tuple[str, ...], *columns: sa.schema.SchemaItem) -> None:
    op.create_table(table, _whole("test_id"), _whole("line"), *columns,
                    sa.ForeignKeyConstraint(["test_id", "line"], ["line.test_id", "line.number"],
                                            name=f"fk_{table}_test_id_line", ondelete="CASCADE"),
                    sa.PrimaryKeyConstraint("test_id", "line", *key, name=f"pk_{table}"), sqlite_with_rowid=False)


def _text(name: str) -> sa.Column[str]:
    return sa.Column(name, sa.String(), nullable=False)


def _whole(name: str) -> sa.Column[int]:
    return sa.Column(name, sa.Integer(), nullable=False, autoincrement=False)


def _flag(name: str) -> sa.Column[bool]:
    return sa.Column(name, sa.Boolean(), nullable=False)


def _number(name: str) -> sa.Column[float]:
    return sa.Column(name, sa.Float())
