"""Free space on the robot's disks: the disk of a folder, and the limit of a full one."""
# SPDX-License-Identifier: Apache-2.0
import pathlib

import pytest

from mtr_dispatcher.disks.room import FINE_SHARE, FULL_MB, MEGA, RESERVE_BYTES, DiskLimit, Room, room_at

LOG, HOME = pathlib.Path("/var/log/robot"), pathlib.Path("/home/robot")


def rooms(*free_mb):
    return [Room(folder, 64e9, MEGA * free) for folder, free in zip((LOG, HOME), free_mb)]


@pytest.mark.parametrize("free_mb, folder", [
    ((300.0, 300.0), None), ((200.0, 200.0), None), ((199.0, 300.0), LOG), ((300.0, 0.0), HOME), ((10.0, 5.0), LOG)])
def test_disk_of_any_folder_is_full_below_the_limit(free_mb, folder):
    found = DiskLimit(200.0).full(rooms(*free_mb))
    assert (found and found.folder) == folder


def test_disk_that_was_full_has_to_have_more_until_it_is_not():
    limit = DiskLimit(200.0)
    told = [limit.full(rooms(free_mb)) is not None for free_mb in (210.0, 190.0, 210.0, 249.0, 250.0, 210.0, 190.0)]
    assert told == [False, True, True, True, False, False, True] and limit.needed_mb == 250.0


def test_disk_with_room_for_a_day_is_not_told_as_full():
    assert MEGA * FULL_MB * FINE_SHARE < RESERVE_BYTES


@pytest.mark.parametrize("total_bytes, reserve_bytes", [(10e9, 1e9), (20e9, 1e9), (100e9, 5e9)])
def test_day_of_work_needs_a_gigabyte_and_a_twentieth(total_bytes, reserve_bytes):
    assert Room(LOG, total_bytes, 0.0).reserve_bytes == pytest.approx(reserve_bytes)


@pytest.mark.parametrize("trouble", [FileNotFoundError(), PermissionError(), NotADirectoryError()])
def test_folder_that_is_not_there_or_not_shown_has_the_room_of_what_it_lies_in(trouble):
    def usage(path):
        if path != pathlib.Path("/var"):
            raise trouble
        return 10, 4, 6
    assert room_at(LOG, usage) == Room(LOG, 10, 6)
    assert room_at(HOME, usage) is None


def test_room_is_what_the_system_says(tmp_path):
    found = room_at(tmp_path / "not" / "there")
    assert found.folder == tmp_path / "not" / "there" and found.total_bytes >= found.free_bytes > 0
