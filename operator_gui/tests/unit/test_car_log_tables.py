"""Tables of frames with the words, columns and units that different tools write: understood, or refused by line."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.errors import ConnectionFailed

YES = ("true", "True", "TRUE", "1", "yes", "Yes", "y", "Y", "t", "x", "on", '"true"', " 1 ")
NO = ("false", "False", "FALSE", "0", "no", "N", "f", "off", "")
OTHERS = ("2", "maybe", "-1", "truely", "1.0", "?")


def log_of(folder, head, rows, encoding="utf-8"):
    path = folder / "bus.csv"
    path.write_bytes("".join(f"{line}\n" for line in (head, *rows)).encode(encoding))
    return ReadLog(path)


def frames_of(read):
    return [(frame.can_id, frame.is_extended, frame.data) for frame in read]


@pytest.mark.parametrize("column", ["Error", "Remote", "RTR", "IsError", "is_remote_frame", "Error Frame"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_error_and_remote_frames_are_no_data_in_each_word(tmp_path, column, delimiter):
    head = delimiter.join(["Time", "ID", column, "DLC", "Data"])
    words = [word for pair in zip(YES, NO * 2) for word in pair]
    read = log_of(tmp_path, head, [delimiter.join([f"{0.1 * at:.1f}", "321", word, "1", f"{at:02X}"])
                                   for at, word in enumerate(words)])
    assert frames_of(read) == [(0x321, False, bytes([at])) for at, word in enumerate(words) if word in NO]
    assert read.notice == ""


@pytest.mark.parametrize("column", ["error", "remote"])
@pytest.mark.parametrize("word", OTHERS)
def test_word_that_is_neither_yes_nor_no_is_refused_with_its_line(tmp_path, column, word):
    read = log_of(tmp_path, f"Time,ID,{column},DLC,Data", ["0.0,321,0,1,01", f"0.1,321,{word},1,02", "0.2,321,0,1,03"])
    assert [frame.data for frame in read] == [b"\1", b"\3"]
    assert f"line 3 has the word {word} in the column {column}, which is neither yes nor no: " in read.notice
    with pytest.raises(ConnectionFailed, match="line 2 has the word"):
        log_of(tmp_path, f"Time,ID,{column},DLC,Data", [f"0.1,321,{word},1,02"])


def test_error_frame_of_a_remote_column_with_a_strange_word_is_not_data(tmp_path):
    read = log_of(tmp_path, "Time,ID,Remote,Error,DLC,Data", ["0.0,321,no,no,1,01", "0.1,321,yes,what,1,02"])
    assert [frame.data for frame in read] == [b"\1"] and "line 3 has the word what" in read.notice


EXTENDED = ("Extended", "extended", "EXT", "Xtd", "Y", "yes", "True", "1", "x", "29", "29 bit", "29-bit")
STANDARD = ("Standard", "std", "STD", "s", "N", "no", "False", "0", "11", "11 Bit", "11-bit", "")


@pytest.mark.parametrize("column", ["Extended", "ext", "IsExtended", "IDE", "extended_id", "ID Type"])
@pytest.mark.parametrize(("extended", "standard"), list(zip(EXTENDED, STANDARD)))
def test_format_of_an_identifier_is_understood_in_each_word(tmp_path, column, extended, standard):
    read = log_of(tmp_path, f"Time,ID,{column},DLC,Data", [f"0.0,321,{extended},1,01", f"0.1,321,{standard},1,02",
                                                           f"0.2,18DA10F1,{extended},1,03"])
    assert frames_of(read) == [(0x321, True, b"\1"), (0x321, False, b"\2"), (0x18DA10F1, True, b"\3")]
    assert read.notice == ""


@pytest.mark.parametrize("word", ["CAN", "extent", "2", "?", "10", "-1", "FD"])
def test_word_that_is_no_format_of_an_identifier_is_refused_with_its_line(tmp_path, word):
    read = log_of(tmp_path, "Time,ID,Extended,DLC,Data", ["0.0,321,no,1,01", f"0.1,321,{word},1,02"])
    assert frames_of(read) == [(0x321, False, b"\1")]
    assert f"line 3 has the word {word} in the column extended" in read.notice


def test_identifier_without_a_format_is_extended_when_it_is_too_large_for_a_standard_one(tmp_path):
    read = log_of(tmp_path, "Time,ID,Extended,DLC,Data", ["0.0,7FF,,1,01", "0.1,800,,1,02"])
    assert frames_of(read) == [(0x7FF, False, b"\1"), (0x800, True, b"\2")]


BUSES = "Time,ID,Bus,DLC,Data"


@pytest.mark.parametrize("column", ["Bus", "Channel", "Chn"])
@pytest.mark.parametrize(("names", "channels"), [
    (("0", "1"), [0, 1]), (("1", "2"), [1, 2]), (("can0", "can1"), [0, 1]), (("CAN 1", "CAN 2"), [1, 2]),
    (("CAN_1", "CAN-0"), [1, 0]), (("HS", "HS"), [0, 0]), (("", ""), [0, 0]), (("vcan12", "vcan3"), [12, 3])])
def test_buses_of_a_table_have_the_numbers_in_their_names(tmp_path, column, names, channels):
    read = log_of(tmp_path, BUSES.replace("Bus", column),
                  [f"{0.1 * at:.1f},321,{name},1,0{at}" for at, name in enumerate(names)])
    assert [frame.channel for frame in read] == channels and read.notice == ""


@pytest.mark.parametrize("names", [("HS", "MS"), ("can0", "vcan0"), ("0", "HS"), ("body", "can1"), ("CAN", "CAN 1")])
def test_buses_of_a_table_that_cannot_be_numbered_are_refused(tmp_path, names):
    with pytest.raises(ConnectionFailed, match=f"names the buses {names[0]} and {names[1]}, and only names with"):
        log_of(tmp_path, BUSES, [f"{0.1 * at:.1f},321,{names[at % 2]},1,01" for at in range(6)])


def columns_of(names):
    return ["Time", "ID", *[f"{names}{at}" for at in range(8)]]


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("names", ["D", "B", "Data", "Byte ", "data_", "DataByte", "d0"])
@pytest.mark.parametrize("form", ["X", "02x", "#x"])
def test_each_column_of_a_byte_is_one_byte(tmp_path, delimiter, names, form):
    datas = [bytes((first + at) % 256 for at in range(size)) for first in (0, 1, 9, 15, 16, 250) for size in range(9)]
    rows = [delimiter.join([f"{0.1 * at:.1f}", "321", *[f"{byte:{form}}" for byte in data]] + [""] * (8 - len(data)))
            for at, data in enumerate(datas)]
    read = log_of(tmp_path, delimiter.join(columns_of(names)), rows)
    assert [frame.data for frame in read] == datas and read.notice == ""


@pytest.mark.parametrize(("behind", "row", "data"), [
    ("Error", "0.1,321,1,2,,,,,,,0", b"\1\2"), ("Error", "0.1,321,1,2,,,,,,,true", None),
    ("Bus", "0.1,321,1,0,0,0,0,0,0,10,3", b"\1\0\0\0\0\0\0\x10"), ("DLC", "0.1,321,1,2,0,0,0,0,0,0,2", b"\1\2"),
    ("ASCII", "0.1,321,41,42,,,,,,,AB", b"AB"), ("Data", "0.1,321,41,42,,,,,,,41 42", b"AB")])
def test_columns_behind_those_of_the_bytes_are_no_data(tmp_path, behind, row, data):
    read = log_of(tmp_path, ",".join([*columns_of("D"), behind]), ["0.0,321,1", row])
    assert [frame.data for frame in read][1:] == ([] if data is None else [data]) and read.notice == ""


@pytest.mark.parametrize("cells", ["1,,3", "1,2x,3", "1,100,3", "001,2,3", ",2", "1 2,3", "-1,2", "+1,2"])
def test_column_that_is_not_one_byte_is_refused_with_its_line(tmp_path, cells):
    read = log_of(tmp_path, ",".join(columns_of("D")), ["0.0,321,1,2", f"0.1,321,{cells}"])
    assert [frame.data for frame in read] == [b"\1\2"]
    assert "line 3 has a byte of data that is no number" in read.notice


@pytest.mark.parametrize(("text", "data"), [
    ("1 0 0 0", b"\1\0\0\0"), ("01 00", b"\1\0"), ("0100", b"\1\0"), ("0100 0203", b"\1\0\2\3"), ("5", b"\5"),
    ("", b""), ("0x5", b"\5"), ("0x1 0x02", b"\1\2"), ("010", None), ("1 203", None), ("1 0203", None)])
def test_words_of_a_column_without_length_are_bytes(tmp_path, text, data):
    read = log_of(tmp_path, "Time,ID,Data", ["0.0,321,00", f"0.1,321,{text}"])
    assert [frame.data for frame in read][1:] == ([] if data is None else [data])
    assert ("line 3 has a byte" in read.notice) == (data is None)


FD_LENGTHS = (*range(9), 12, 16, 20, 24, 32, 48, 64)
FORMS = {"columns": (",".join(["Time,ID,DLC", *[f"D{at}" for at in range(64)]]), ","),
         "few columns": ("Time,ID,DLC,D1,D2,D3,D4,D5,D6,D7,D8", ","), "words": ("Time,ID,DLC,Data", " "),
         "text": ("Time,ID,DLC,Data", "")}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("is_code", [True, False], ids=["code", "length"])
def test_length_of_fd_frames_may_be_a_code(tmp_path, form, is_code):
    head, blank = FORMS[form]
    datas = [bytes(range(255, 255 - length, -1)) for length in FD_LENGTHS]
    read = log_of(tmp_path, head, [
        f"{0.1 * at:.1f},321,{FD_LENGTHS.index(len(data)) if is_code else len(data)},"
        + blank.join(f"{byte:02X}" for byte in data) for at, data in enumerate(datas)])
    assert [(frame.data, frame.is_fd) for frame in read] == [(data, len(data) > 8) for data in datas]
    assert read.notice == ""


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("length", "present"), [
    (9, 8), (9, 10), (9, 16), (9, 64), (12, 8), (12, 16), (12, 64), (13, 24), (15, 16), (15, 63), (16, 12), (24, 20)])
def test_length_that_contradicts_the_bytes_of_a_table_is_refused(tmp_path, form, length, present):
    head, blank = FORMS[form]
    read = log_of(tmp_path, head, ["0.0,321,0,", f"0.1,321,{length}," + blank.join(["01"] * present)])
    assert [frame.data for frame in read] == [b""]
    assert f"line 3 has {present} bytes of data, and says {length}" in read.notice


@pytest.mark.parametrize(("length", "padding"), [(2, 8), (0, 8), (8, 64), (2, 64), (16, 64), (48, 64)])
def test_columns_that_are_filled_up_are_no_data(tmp_path, length, padding):
    cells = ",".join(["11"] * length + ["0"] * (padding - length))
    read = log_of(tmp_path, FORMS["columns"][0], [f"0.1,321,{length},{cells}"])
    assert [frame.data for frame in read] == [b"\x11" * length] and read.notice == ""


@pytest.mark.parametrize(("unit", "unit_s"), [
    ("us", 1e-6), ("\N{MICRO SIGN}s", 1e-6), ("\N{GREEK SMALL LETTER MU}s", 1e-6), ("ms", 1e-3), ("s", 1.0)])
@pytest.mark.parametrize("column", ["Time ({})", "Time [{}]", "Time_{}", "Timestamp/{}", "Time {}"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_unit_in_the_header_counts(tmp_path, unit, unit_s, column, encoding):
    if encoding == "cp1252" and not unit.isascii():
        unit = "\N{MICRO SIGN}s"
    read = log_of(tmp_path, f"{column.format(unit)},ID,DLC,Data",
                  [f"{20_000 * at}{'.0' * (at % 2)},321,1,01" for at in range(5)], encoding)
    assert [frame.time_s for frame in read] == pytest.approx([20_000 * unit_s * at for at in range(5)])


@pytest.mark.parametrize(("length", "text", "data"), [
    (1, "0x5", b"\5"), (1, "5", b"\5"), (2, "0x5 6", b"\5\6"), (2, "0506", b"\5\6"), (2, "05 06 00", b"\5\6")])
def test_words_of_a_column_with_length_are_bytes(tmp_path, length, text, data):
    read = log_of(tmp_path, "Time,ID,DLC,Data", [f"0.1,321,{length},{text}"])
    assert [frame.data for frame in read] == [data] and read.notice == ""
