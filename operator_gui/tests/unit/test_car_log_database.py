"""python-can's databases from strangers: only stored rows are read, and each refusal has its reason."""
# SPDX-License-Identifier: Apache-2.0
import sqlite3
import threading
import tracemalloc

import can
import pytest

from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.errors import ConnectionFailed

COUNT = 50
CREATE = ("CREATE TABLE messages (ts REAL, arbitration_id INTEGER, extended INTEGER, remote INTEGER, error INTEGER, "
          "dlc INTEGER, data {})")
VIEW = "CREATE VIEW messages AS {} SELECT 1.0 AS ts, 1 AS arbitration_id, 0 AS extended, 0 AS remote, 0 AS error, "


def outcome(path):
    """Number of frames, and the sentence that says what is wrong."""
    try:
        read = ReadLog(path)
        return len(list(read)), read.ending
    except ConnectionFailed as error:
        return 0, str(error)


def written(path):
    with can.Logger(str(path)) as log:
        for index in range(COUNT):
            log.on_message_received(can.Message(timestamp=1.7e9 + index, arbitration_id=0x100, is_extended_id=False,
                                                data=bytes([index] * (index % 9))))
        log.on_message_received(can.Message(timestamp=1.8e9, is_error_frame=True))
        log.on_message_received(can.Message(timestamp=1.8e9, arbitration_id=1, is_remote_frame=True, dlc=8))
    return path


def database(path, *statements):
    connection = sqlite3.connect(path)
    for statement in statements:
        connection.execute(statement)
    connection.commit()
    connection.close()
    return path


def test_log_of_the_library_is_read_and_not_written(tmp_path):
    path = written(tmp_path / "bus #1 of 100 %? .db")
    before = path.read_bytes()
    read = ReadLog(path)
    assert [frame.data for frame in read] == [bytes([index] * (index % 9)) for index in range(COUNT)]
    assert read.notice == "" and path.read_bytes() == before


def test_log_may_be_read_on_in_another_thread(tmp_path):
    frames = iter(ReadLog(written(tmp_path / "bus.db")))
    next(frames)
    rest = []
    thread = threading.Thread(target=lambda: rest.extend(frames))
    thread.start()
    thread.join()
    assert len(rest) == COUNT - 1


@pytest.mark.parametrize("statements", [
    (VIEW.format("") + "8 AS dlc, zeroblob(900000000) AS data",),
    (VIEW.format("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n)") + "0 AS dlc, x'' AS data FROM n",),
    (CREATE.format("BLOB AS (zeroblob(900000000))"), "INSERT INTO messages VALUES (1.0, 1, 0, 0, 0, 8)")],
    ids=["blob of a view", "endless rows", "computed column"])
def test_database_that_computes_what_it_does_not_store_is_refused_in_little_memory(tmp_path, statements):
    path = database(tmp_path / "bus.db", *statements)
    tracemalloc.start()
    count, sentence = outcome(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert (count, sentence) == (0, f"The CAN log {path} cannot be read: its table messages computes values that it "
                                    "does not store.")
    assert peak < 1024 ** 2


@pytest.mark.parametrize(("row", "words"), [
    ("2.0, 1, 0, 0, 0, 8, x'0102'", "row 2 has 2 bytes of data, and says 8"),
    ("2.0, 1, 0, 0, 0, 'many', x'0102'", "row 2 has 2 bytes of data, and says many"),
    ("2.0, 1, 0, 0, 0, 65, zeroblob(65)", "row 2 holds what no bus has carried"),
    ("2.0, 5000, 0, 0, 0, 0, x''", "row 2 holds what no bus has carried"),
    ("1e300, 1, 0, 0, 0, 0, x''", "row 2 has the time 1e+300 s, which no clock shows"),
    ("'now', 1, 0, 0, 0, 0, x''", "row 2 has values of other types"), ("NULL, 1, 0, 0, 0, 0, x''", "row 2 has values"),
    ("2.0, 'A', 0, 0, 0, 0, x''", "row 2 has values"), ("2.0, 1, 0, 0, 0, 1, 'A'", "row 2 has values")])
def test_row_that_is_no_frame_ends_the_log_with_its_number(tmp_path, row, words):
    good = "INSERT INTO messages VALUES (1.0, 1, 0, 0, 0, 1, x'01')"
    path = database(tmp_path / "bus.db", CREATE.format("BLOB"), good, f"INSERT INTO messages VALUES ({row})", good)
    count, sentence = outcome(path)
    assert count == 1 and f"is damaged after 1 frames ({words}" in sentence and sentence.endswith("; those are used.")


@pytest.mark.parametrize(("content", "words"), [
    (b"SQLite format 3\0", "cannot be read: SQLite reports: file is not a database"),
    (b"SQLite format 3\0" + bytes(range(256)) * 20, "cannot be read: SQLite reports: ")])
def test_file_that_only_begins_like_a_database_is_refused_with_the_reason(tmp_path, content, words):
    path = tmp_path / "bus.db"
    path.write_bytes(content)
    count, sentence = outcome(path)
    assert count == 0 and words in sentence and sentence.endswith(".")


def test_database_of_something_else_is_refused(tmp_path):
    path = database(tmp_path / "bus.db", "CREATE TABLE other (a)")
    count, sentence = outcome(path)
    assert count == 0 and sentence.endswith(" cannot be read: it has no table messages, as python-can writes it.")


def test_database_that_is_cut_off_or_changed_gives_no_wrong_reason(tmp_path):
    path = written(tmp_path / "bus.db")
    whole = path.read_bytes()
    for place in range(16, len(whole), 61):
        for content in (whole[:place], whole[:place] + bytes([whole[place] ^ 0x55]) + whole[place + 1:]):
            path.write_bytes(content)
            count, sentence = outcome(path)
            assert count or "cannot be read: " in sentence or "holds no frame." in sentence
