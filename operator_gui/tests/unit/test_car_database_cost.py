"""Databases of strangers that would cost processor time without limit. C6"""
# SPDX-License-Identifier: Apache-2.0
import gc
import time

import pytest
from database_kinds import Frame, dbc, kcd, sym, written

from mtr_operator.car_link.database.load import load_database
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.errors import ConnectionFailed

# Of the time of an empty loop, 0.05 s; without their limits, all of these files take 120 times of it to hours.
MAX_LOOPS = 80.0
LOCK = ("LOCK", 0, 2)
DOORS = Frame("DOORS", 0x321, [LOCK])
FAULT = "@ no DBC\n"


def _loaded_in_time(folder, suffix, text):
    written(folder, suffix, text)
    # A collection takes as long as all other objects of the process are many.
    gc.disable()
    begin = time.process_time()
    try:
        return load_database(folder / f"car{suffix}")
    except ConnectionFailed as error:
        return str(error)
    finally:
        used_s = time.process_time() - begin
        gc.enable()
        assert used_s < MAX_LOOPS * _loop_s()


def _loop_s():
    """Time of a loop beside which other processes are as busy."""
    begin = time.process_time()
    for _ in range(2_000_000):
        pass
    return time.process_time() - begin


def _pages(signals):
    return "".join(f' SG_ P{number} m0 : 8|8@1+ (1,0) [0|0] "" A\n' for number in range(signals))


@pytest.mark.parametrize("text", [
    dbc([DOORS, Frame("A", 1, [("S", 0, 8)] * 4000)]) + FAULT + "SIG_VALTYPE_ 1 S : 1;\n" * 4000,
    dbc([DOORS] + [Frame(f"A{i}", 1, [("S", 0, 8)]) for i in range(3000)]) + FAULT + "SIG_VALTYPE_ 1 S : 1;\n" * 3000,
    dbc([DOORS] + [Frame(f"A{i}", 1, []) for i in range(3000)]) + FAULT
    + 'BA_ "GenMsgCycleTime" BO_ 1 100;\nBA_ "SystemMessageLongSymbol" BO_ 1 "A";\n' * 3000,
    dbc([DOORS, Frame("A", 1, [("S", 0, 8)] * 4000)]) + FAULT + 'BA_ "SystemSignalLongSymbol" SG_ 1 Q "L";\n' * 4000,
    dbc([DOORS]) + "BO_ 1 A: 8 A\n SG_ S M : 0|8@1+ (1,0) [0|0] \"\" A\n" + _pages(1000) + FAULT
    + "".join(f"SG_MUL_VAL_ 1 P{number} S 0-4000;\n" for number in range(1000)),
    dbc([DOORS]) + "BO_ 1 A: 8 A\n" + _pages(4000).replace(" m0 ", " M ") + _pages(4000) + FAULT,
], ids=["one message", "one identifier", "cycle times", "long names", "values", "multiplexers"])
def test_statements_for_many_signals_take_no_time(tmp_path, text):
    database = _loaded_in_time(tmp_path, ".dbc", text)
    assert database.signal(database.message("DOORS"), "LOCK") == "LOCK"


def test_signals_of_one_name_are_unusable_when_a_statement_of_the_decoding_has_no_single_one(tmp_path):
    text = dbc([DOORS, Frame("A", 1, [("S", 0, 32)] * 17)]) + FAULT + "SIG_VALTYPE_ 1 S : 1;\n"
    database = _loaded_in_time(tmp_path, ".dbc", text)
    with pytest.raises(ConnectionFailed, match="SIG_VALTYPE_ 1 S : 1;"):
        database.signal(database.message("A"), "S")


def test_usual_pages_of_a_faulty_file_are_read(tmp_path):
    pages = "".join(f' SG_ P{page} m{page} : 8|8@1+ (1,0) [0|0] "" A\n' for page in range(256))
    text = dbc([DOORS]) + ' SG_ MUX M : 2|8@1+ (1,0) [0|0] "" A\n' + pages + FAULT
    assert load_profile(written(tmp_path, ".dbc", text)).decode(0x321, False, b"\x01" + bytes(7))


def test_long_name_of_a_bus_is_not_read_once_a_message(tmp_path):
    text = kcd([Frame(f"A{number}", 1, []) for number in range(4000)]).replace("bus0", "b" * 500_000)
    assert " cannot be read: KCD: " in _loaded_in_time(tmp_path, ".kcd", text.replace('id="1"', 'id="x"'))


def test_deeply_nested_message_costs_no_other_message(tmp_path):
    nested, name = "<Signal>" * 20_000 + "</Signal>" * 20_000, 'name="DEEP" length="8">'
    text = kcd([DOORS, Frame("DEEP", 1, [])]).replace(name, name + nested)
    database = _loaded_in_time(tmp_path, ".kcd", text)
    assert database.signal(database.message("DOORS"), "LOCK") == "LOCK"
    with pytest.raises(ConnectionFailed, match="Message DEEP .* cannot be used: it is nested too deeply"):
        database.message("DEEP")


SYM_BAD = "[BAD]\nID=1h\nVar=A foo 0,8\n"


@pytest.mark.parametrize("added", [
    "[A]\nID=0h-1FFFFFFFh\nVar=X unsigned 0,8\n", "[A]\nID = 000000000000h -1FFFFFFFFFFFFFFFh\n",
    "[A]\nID=0h 01FFFFFFFh\n", "[A]\nID=0h-00FFFFh\nVar=X unsigned 0,8\n",
    "".join(f"[A]\nMux=P{page} 0,16 0{page:X}h\nVar=X{page} unsigned 16,8\n" for page in range(3000)) + "ID=1h\n",
    "".join(f"[A]\nID=1h\nMux=P{page} 0,16 0{page:X}h\nVar=X{page} unsigned 16,8\n" for page in range(500))],
    ids=["range", "digits", "without minus", "half", "pages", "identifiers of pages"])
@pytest.mark.parametrize("bad", ["", SYM_BAD])
def test_ranges_and_pages_of_a_sym_message_cost_nothing_else(tmp_path, added, bad):
    database = _loaded_in_time(tmp_path, ".sym", sym([DOORS]) + added + bad)
    if "Mux" in added:
        assert database.signal(database.message("DOORS"), "LOCK") == "LOCK"
    else:
        # Its identifier is in the range.
        with pytest.raises(ConnectionFailed, match="message A, .* has the same identifier 0x321 and could not be read"):
            database.signal(database.message("DOORS"), "LOCK")
    with pytest.raises(ConnectionFailed, match="Message A .* cannot be used: (its ranges|a message has too many)"):
        database.message("A")


def test_ranges_of_all_sym_messages_together_are_limited(tmp_path):
    ranges = "".join(f"[A{number}]\nID=00h-0FFFh\nVar=X unsigned 0,8\n" for number in range(50))
    assert "repeat more than 16384 signals." in _loaded_in_time(tmp_path, ".sym", sym([DOORS]) + ranges)


def test_usual_range_and_pages_of_a_sym_file_are_read(tmp_path):
    pages = "".join(f"[P]\n{'ID=100h-11Fh' if not page else ''}\nMux=M{page} 0,8 0{page:X}h\nVar=X{page} unsigned 8,8\n"
                    for page in range(100))
    database = _loaded_in_time(tmp_path, ".sym", sym([DOORS]) + pages)
    assert len(database.messages) == 33 and database.signal(database.message("DOORS"), "LOCK") == "LOCK"


def test_table_that_all_sym_messages_use_is_not_read_once_a_message(tmp_path):
    table = "{ENUMS}\nEnum=E(" + ",".join(f'{value}="v{value}"' for value in range(8000)) + ")\n{SENDRECEIVE}"
    messages = "".join(f"[A{number}]\nID=1h\nVar=X unsigned 0,8 /e:E\n" for number in range(200))
    text = sym([DOORS]).replace("{SENDRECEIVE}", table) + messages + SYM_BAD
    assert " cannot be read: SYM: " in _loaded_in_time(tmp_path, ".sym", text)


@pytest.mark.parametrize("line", ["Var=X unsigned 8,8 /max:{}\n", 'Var=X unsigned 8,8 /u:"{}"\n', "Color={}\n"])
def test_digits_of_a_sym_message_cost_no_other_message(tmp_path, line):
    text = sym([DOORS]) + "[A]\nID=1h\n" + line.format("1" * 30_000)
    database = _loaded_in_time(tmp_path, ".sym", text)
    assert database.signal(database.message("DOORS"), "LOCK") == "LOCK"


def test_pages_of_a_kcd_message_cost_no_other_message(tmp_path):
    pages = "".join(f'<MuxGroup count="{page}"><Signal name="S" offset="16" length="8"/></MuxGroup>'
                    for page in range(6000))
    text = kcd([DOORS, Frame("A", 1, [])]).replace(
        'name="A" length="8">', f'name="A" length="8"><Multiplex name="M" offset="0" length="16">{pages}</Multiplex>')
    database = _loaded_in_time(tmp_path, ".kcd", text)
    assert database.signal(database.message("DOORS"), "LOCK") == "LOCK"
    with pytest.raises(ConnectionFailed, match="Message A .* cannot be used: a message has too many pages"):
        database.message("A")
