"""Logs of a bus as other tools write them: each is read whole, or what is left out is told with its line."""
# SPDX-License-Identifier: Apache-2.0
import gzip

import can
import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.log.bus_log import BusLog
from mtr_operator.car_link.log.log_car import LogCarLink
from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.errors import ConnectionFailed, OutputError
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus

LOCK, SPEED, LONG = 0x321, 0x1A0, 0x18DA10F1
COUNT = 200
# Time, identifier, whether it is an extended one, data and bus: three messages on two buses.
FRAMES = [(round(0.05 * index + (0.0003 if index % 2 else 0.0), 6), *(
    (LOCK, False, bytes([1 if index < 100 else 2, index % 256]), 0), (SPEED, False, bytes(range(4)), 0),
    (LONG, True, bytes([index % 256] * 8), 1))[index % 3]) for index in range(COUNT)]
NAMES = {"DOORS": (LOCK, False), "SPEED": (SPEED, False), "LONG": (LONG, True)}


def blanks(data):
    return " ".join(f"{byte:02X}" for byte in data)


def candump(time_s, can_id, is_extended, data, bus):
    return f"({1.7e9 + time_s:.6f}) can{bus} {can_id:0{8 if is_extended else 3}X}#{data.hex().upper()}"


def console(clock, extra=""):
    def line(time_s, can_id, is_extended, data, bus):
        return (f" {clock(time_s)}  can{bus}{extra}  {can_id:0{8 if is_extended else 3}X}   [{len(data)}]  "
                f"{blanks(data)}")
    return line


def asc(*frame, base="X"):
    time_s, can_id, is_extended, data, bus = frame
    numbers = " ".join(f"{byte:02X}" if base == "X" else str(byte) for byte in data)
    identifier = f"{can_id:{base}}{'x' if is_extended else ''}"
    return f"   {time_s:.6f} {bus + 1}  {identifier:<15} Rx   d {len(data)} {numbers}"


def named(time_s, can_id, is_extended, data, bus):
    name = next(name for name, key in NAMES.items() if key == (can_id, is_extended))
    return f"   {time_s:.6f} {bus + 1}  {name:<15} Rx   d {len(data)} {blanks(data)}"


def with_length(*frame):
    return f"{asc(*frame)}  Length = 244000 BitCount = 125 ID = {frame[1]}{'x' if frame[2] else ''}"


def canfd(time_s, can_id, is_extended, data, bus):
    identifier = f"{can_id:X}{'x' if is_extended else ''}"
    return (f"   {time_s:.6f} CANFD   {bus + 1} Rx   {identifier:>8}                                  1 0 "
            f"{len(data):x} {len(data):2d} {blanks(data)}        0    0     1000        0        0        0")


def trc(columns):
    def line(time_s, can_id, is_extended, data, bus):
        number = f"{round(1000 * time_s):>7}"
        values = {"N": number if "T" in columns else f"{number})", "O": f"{1000 * time_s:.3f}", "T": "DT",
                  "B": str(bus + 1), "I": f"{can_id:0{8 if is_extended else 4}X}", "d": "Rx", "R": "-",
                  "L": str(len(data)), "l": str(len(data)), "D": blanks(data)}
        return "  ".join(values[column] for column in columns.split(","))
    return line


def gvret(time_s, can_id, is_extended, data, bus):
    return (f"{round(time_s * 1e6)},{can_id:08X},{'true' if is_extended else 'false'},Rx,{bus},{len(data)},"
            + "".join(f"{byte:02X}," for byte in data))


def table(time_s, can_id, is_extended, data, bus):
    return f"{time_s:.6f};{can_id:X};{int(is_extended)};{bus};{len(data)};{data.hex()}"


def busmaster(time_s, can_id, is_extended, data, bus):
    seconds, parts = divmod(round(time_s * 1e4), 10_000)
    return (f"22:13:{seconds + 20:02d}:{parts:04d} Rx {bus + 1} 0x{can_id:X} {'x' if is_extended else 's'} {len(data)} "
            f"{blanks(data)}")


def crtd(time_s, can_id, is_extended, data, bus):
    return f"{1.7e9 + time_s:.6f} {bus + 1}R{29 if is_extended else 11} {can_id:X} {blanks(data)}"


def steps(line):
    """Of each frame the time since the one before."""
    def stepped(frames):
        before_s = 0.0
        for time_s, *rest in frames:
            yield line(round(time_s - before_s, 6), *rest)
            before_s = time_s
    return stepped


def each(line):
    return lambda frames: (line(*frame) for frame in frames)


def clock(time_s):
    return f"(2023-11-14 22:13:{20 + time_s:09.6f})"


ASC_HEAD = ("date Tue Nov 14 10:13:20.000 pm 2023\nbase hex  timestamps absolute\ninternal events logged\n"
            "// version 9.0.0\nBegin Triggerblock Tue Nov 14 10:13:20.000 pm 2023\n   0.000000 Start of measurement\n")
ASC_DEC = ASC_HEAD.replace("hex", "dec")
ASC_STEPS = ASC_HEAD.replace("absolute", "relative")
TRC = ";$FILEVERSION={}\n;$STARTTIME=45244.9259259259\n;\n"
TRC_COLUMNS = ";$FILEVERSION={}\n;$STARTTIME=45244.9259259259\n;$COLUMNS={}\n;\n"
GVRET = "Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n"
MASTER = ("***BUSMASTER Ver 3.2.2***\n***PROTOCOL CAN***\n***[START LOGGING SESSION]***\n***HEX***\n***SYSTEM MODE***\n"
          "***<Time><Tx/Rx><Channel><CAN ID><Type><DLC><DataBytes>***\n")
# Header, lines of frames, what is lost: "" nothing, "bus" the number of the bus, "ms" parts of a millisecond.
KINDS = {
    "candump.log": ("", each(candump), ""),
    "candump, directions.log": ("", each(lambda *frame: f"{candump(*frame)} R"), ""),
    "candump, vcan.log": ("", each(lambda *frame: candump(*frame).replace("can", "vcan")), ""),
    "candump, slcan.log": ("", each(lambda *frame: candump(*frame).replace("can", "slcan")), ""),
    "console -t a.log": ("", each(console(lambda time_s: f"({1.7e9 + time_s:.6f})")), ""),
    "console -t A.log": ("", each(console(clock)), ""),
    "console -t z.txt": ("", each(console(lambda time_s: f"({time_s:010.6f})")), ""),
    "console -t d.log": ("", steps(console(lambda time_s: f"({time_s:010.6f})")), ""),
    "console -x.log": ("", each(console(lambda time_s: f"({1.7e9 + time_s:.6f})", "  RX - -")), ""),
    "hex.asc": (ASC_HEAD, each(asc), ""), "dec.asc": (ASC_DEC, each(lambda *frame: asc(*frame, base="d")), ""),
    "steps.asc": (ASC_STEPS, steps(asc), ""), "names.asc": (ASC_HEAD, each(named), ""),
    "names and identifiers.asc": (ASC_HEAD, each(with_length), ""), "fd.asc": (ASC_HEAD, each(canfd), "fd"),
    "no header.asc": ("", each(asc), ""),
    "1.0.trc": (TRC.format("1.0"), each(trc("N,O,I,L,D")), "bus"), "none.trc": (";\n", each(trc("N,O,I,L,D")), "bus"),
    "1.1.trc": (TRC.format("1.1"), each(trc("N,O,d,I,L,D")), "bus"),
    "1.2.trc": (TRC.format("1.2"), each(trc("N,O,B,d,I,L,D")), ""),
    "1.3.trc": (TRC.format("1.3"), each(trc("N,O,B,d,I,R,L,D")), ""),
    "2.0.trc": (TRC_COLUMNS.format("2.0", "N,O,T,I,d,l,D"), each(trc("N,O,T,I,d,l,D")), "bus"),
    "2.1.trc": (TRC_COLUMNS.format("2.1", "N,O,T,B,I,d,R,L,D"), each(trc("N,O,T,B,I,d,R,L,D")), ""),
    "comma.trc": ("Time     ID        DLC       Data                    Comment\n", each(
        lambda *frame: f"{frame[0]:.3f}   {frame[1]:0{8 if frame[2] else 3}X}      {len(frame[3])}           "
                       f"{blanks(frame[3])}".replace(".", ",")), "bus ms"),
    "gvret.csv": (GVRET, each(gvret), ""), "gvret without header.csv": ("", each(gvret), ""),
    "gvret without direction.csv": (GVRET.replace("Dir,", ""), each(
        lambda *frame: gvret(*frame).replace("Rx,", "")), ""),
    "milliseconds.csv": (GVRET, each(lambda *frame: gvret(round(frame[0], 3) / 1000, *frame[1:])), "ms"),
    "semicolons.csv": ("Time (s);ID;Ext;Bus;DLC;Data\n", each(table), ""),
    "busmaster.log": (MASTER, each(busmaster), "tenth"),
    "ovms.crtd": ("1700000000.000000 CXX OVMS CRTD\n", each(crtd), ""),
    "colon.txt": ("", each(
        lambda *frame: f"{round(1000 * frame[0])}   0x{frame[1]:03X}: {blanks(frame[3])} "), "bus ms"),
}


def written(folder, name, encoding="utf-8", end="\n"):
    """Path of a log of that kind."""
    head, lines, lost = KINDS[name]
    path = folder / name
    text = head + "".join(f"{line}\n" for line in lines(FRAMES))
    path.write_bytes(text.replace("\n", end).encode(encoding))
    return path, lost


def check(read, lost):
    """All frames, as they were."""
    frames = list(read)
    assert [(each.can_id, each.is_extended, each.data) for each in frames] == [frame[1:4] for frame in FRAMES]
    assert [each.channel for each in frames] == [0 if "bus" in lost else frame[4] for frame in FRAMES]
    assert {each.is_fd for each in frames} == {"fd" in lost}
    accuracy_s = 1e-3 if "ms" in lost else 1e-4 if "tenth" in lost else 3e-6
    assert [each.time_s - frames[0].time_s for each in frames] == pytest.approx(
        [frame[0] for frame in FRAMES], abs=accuracy_s)
    assert read.notice == ""


@pytest.mark.parametrize("name", KINDS)
def test_each_kind_is_read_whole(tmp_path, name):
    path, lost = written(tmp_path, name)
    check(ReadLog(path, NAMES), lost)


@pytest.mark.parametrize("name", ["candump.log", "hex.asc", "2.1.trc", "comma.trc", "gvret.csv", "busmaster.log"])
@pytest.mark.parametrize(("encoding", "end"), [
    ("utf-8-sig", "\n"), ("utf-16", "\r\n"), ("utf-16-le", "\n"), ("utf-8", "\r\n"), ("utf-8", "\n\n")])
def test_each_kind_is_read_in_each_encoding(tmp_path, name, encoding, end):
    path, lost = written(tmp_path, name, encoding, end)
    check(ReadLog(path, NAMES), lost)


@pytest.mark.parametrize("name", ["candump.log", "hex.asc", "gvret.csv"])
def test_packed_log_and_one_with_another_ending_are_read(tmp_path, name):
    path, lost = written(tmp_path, name)
    packed, other = tmp_path / f"{name}.gz", tmp_path / "bus.data"
    packed.write_bytes(gzip.compress(path.read_bytes()))
    other.write_bytes(path.read_bytes())
    for each_path in (packed, other):
        check(ReadLog(each_path, NAMES), lost)


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("line", ["CANFD   Start of measurement", "??", "0.5 1 2 3 4"])
def test_line_that_is_not_understood_is_left_out_and_told(tmp_path, name, line):
    path, _ = written(tmp_path, name)
    lines = path.read_text().splitlines()
    lines.insert(len(lines) - 50, line)
    path.write_text("\n".join(lines) + "\n")
    read = ReadLog(path, NAMES)
    assert len(list(read)) == COUNT and read.ending == ""
    assert f"line {len(lines) - 50} " in read.notice and line in read.notice


@pytest.mark.parametrize("name", KINDS)
def test_last_line_that_is_cut_off_is_left_out_and_told(tmp_path, name):
    path, _ = written(tmp_path, name)
    text = path.read_text().rstrip()
    # Behind the data, ASC may have further columns.
    end = {"fd.asc": -60, "names and identifiers.asc": -45}.get(name, -4)
    path.write_text(text[:end])
    read = ReadLog(path, NAMES)
    assert len(list(read)) == COUNT - 1 and "has 1 line that is not understood and left out" in read.notice


@pytest.mark.parametrize(("name", "lines", "words"), [
    ("a.log", " can0  321   [2]  01 02\n" * 5, "line 1 has no time; record the bus with candump -l, or with -t a"),
    ("a.csv", "a;b;c\n1;2;3\n", 'line 1 is not understood: "a;b;c"; read are candump'),
    ("a.log", "some words\nmore\n", 'line 1 is not understood: "some words"; read are candump'),
    ("a.txt", "some words\nmore\n", 'holds no frame: line 1 is not understood: "some words"'),
    ("a.asc", ASC_HEAD + " 0.1 1  DOORS  Rx   d 1 01\n", "line 7 has the name DOORS in place of an identifier"),
    ("a.log", "(1.0) can0 321#00\n(1.1) body 321#00\n", "names the buses can0 and body, and only names with different"),
    ("a.log", "(1.0) can0 321#00\n(1.1) vcan0 321#00\n", "names the buses can0 and vcan0, and only names with"),
    ("a.log", "(1.0) can0 321#0\n", "line 1 has a byte that is no hexadecimal number"),
    ("a.trc", ";$FILEVERSION=1.1\n 1) 1.0 Rx 0321 8 00 00\n", "line 2 has 2 bytes of data, and says 8"),
    ("a.csv", GVRET + "1,321,false,Rx,0,8,00,00\n", "line 2 has 2 bytes of data, and says 8"),
    ("a.gz", "", "is no CAN log: .* it is empty")])
def test_log_without_a_frame_is_refused_with_its_line(tmp_path, name, lines, words):
    path = tmp_path / name
    path.write_text(lines)
    with pytest.raises(ConnectionFailed, match=words) as raised:
        list(ReadLog(path))
    assert str(raised.value).endswith(".")


def test_single_interface_may_have_any_name(tmp_path):
    path = tmp_path / "a.log"
    path.write_text("(1.0) body 321#00\n(1.1) body 321#00\n")
    assert [frame.channel for frame in ReadLog(path)] == [0, 0]


def test_frames_without_data_are_no_frames_and_no_faults(tmp_path):
    path = tmp_path / "a.log"
    path.write_text("(1.0) can0 321#R8\n(1.1) can0 20000080#0000000000000000\n(1.2) can0 321##100112233\n"
                    "(1.3) can0 321#\n")
    read = ReadLog(path)
    assert [(frame.data, frame.is_fd) for frame in read] == [(b"\x00\x11\x22\x33", True), (b"", False)]
    assert read.notice == ""
    path.write_text(" (1.0)  can0  321   [8]  remote request\n (1.1)  can0  20000080   [8]  00 00 00 00 00 00 00 00   "
                    "ERRORFRAME\n (1.2)  can0  321  [04]  00 11 22 33\n (1.3)  can0  321   [1]  41   'A'\n")
    read = ReadLog(path)
    assert [(frame.data, frame.is_fd) for frame in read] == [(b"\x00\x11\x22\x33", True), (b"A", False)]
    assert read.notice == ""


@pytest.mark.parametrize(("steps_s", "words"), [
    ([0.1, -0.02] * 6, "has 6 frames with an earlier time than the frame before, by up to 0.020 s"),
    ([0.1, 0.0, 0.0] * 3, "has 6 frames with the same identifier and time as a frame before")])
def test_times_that_cannot_be_are_told(tmp_path, steps_s, words):
    path, time_s, lines = tmp_path / "a.log", 5.0, []
    for step_s in steps_s:
        time_s += step_s
        lines.append(f"({time_s:.6f}) can0 321#00\n")
    path.write_text("".join(lines))
    read = ReadLog(path)
    assert len(list(read)) == len(steps_s) and words in read.notice


@pytest.mark.parametrize("suffix", ["blf", "asc", "trc"])
@pytest.mark.parametrize("is_fd", [False, True], ids=["classic", "fd"])
def test_log_that_a_test_writes_is_read_as_it_was_with_two_buses(tmp_path, suffix, is_fd):
    path = tmp_path / f"bus.{suffix}"
    if suffix == "trc" and is_fd:
        with pytest.raises(OutputError, match="of the format trc holds no CAN FD frame; choose blf or asc"):
            BusLog(path, is_fd=True)
        return
    log, frames = BusLog(path, is_fd=is_fd), []
    for index in range(600):
        data = bytes([index % 256] * ((48, 12, 64, 3)[index % 4] if is_fd else index % 9))
        frame = CanFrame(LONG if index % 5 == 0 else LOCK, index % 5 == 0, data, 0.001 * index, is_fd=is_fd)
        log.frame(frame, frame.arrival_s, index % 3)
        frames.append((frame.can_id, frame.is_extended, frame.data, is_fd, index % 3))
    log.error_frame()
    log.close()
    read = ReadLog(path)
    found = list(read)
    assert [(each.can_id, each.is_extended, each.data, each.is_fd, each.channel) for each in found] == frames
    assert [each.time_s - found[0].time_s for each in found] == pytest.approx(
        [0.001 * index for index in range(600)], abs=1e-5)
    assert (log.problem, read.notice) == ("", "")


def test_fd_frame_on_a_bus_without_ends_a_log_that_cannot_hold_it(tmp_path):
    log = BusLog(tmp_path / "bus.trc")
    log.frame(CanFrame(LOCK, False, bytes(8), 0.0), 0.0)
    log.frame(CanFrame(LOCK, False, bytes(12), 0.1, is_fd=True), 0.1)
    log.close()
    assert "ends before the test: A CAN log of the format trc holds no CAN FD frame" in log.problem
    assert len(list(ReadLog(tmp_path / "bus.trc"))) == 1


@pytest.mark.parametrize("suffix", ["log", "csv", "db"])
def test_logs_of_the_library_are_read(tmp_path, suffix):
    path = tmp_path / f"bus.{suffix}"
    with can.Logger(str(path)) as log:
        for time_s, can_id, is_extended, data, bus in FRAMES:
            log.on_message_received(can.Message(timestamp=1.7e9 + time_s, arbitration_id=can_id,
                                                is_extended_id=is_extended, data=data, channel=bus))
    check(ReadLog(path), "" if suffix == "log" else "bus")


@pytest.mark.parametrize("name", ["candump.log", "names.asc", "steps.asc", "2.1.trc", "gvret.csv", "comma.trc"])
def test_changes_of_a_log_come_at_their_time(tmp_path, name):
    path, _ = written(tmp_path, name)
    (tmp_path / "car.dbc").write_text(
        'VERSION ""\nBU_: Body\nBO_ 801 DOORS: 8 Body\n SG_ LOCK : 0|2@1+ (1,0) [0|3] "" Body\n'
        "BO_ 416 SPEED: 4 Body\nBO_ 2564428017 LONG: 8 Body\n")
    profile = tmp_path / "car.yaml"
    profile.write_text("database: car.dbc\nmessage: DOORS\nsignal: LOCK\nstates: {1: locked, 2: unlocked}\n"
                       "cycle_time_s: 0.15\n")
    car = LogCarLink(path, str(profile))
    car.connect()
    events = []
    for index in range(95):
        time_s = 50.0 + 0.1 * index
        events += car.observe(RobotStatus(index, 1, time_s, sent_s=time_s, steady_s=time_s))
    event, = events
    assert event.lock_state is LockState.UNLOCKED and event.doubt == ""
    assert event.time_s == pytest.approx(50.0 + 5.1 - 0.075, abs=0.005)
    assert car.notices == ()
    car.close()
