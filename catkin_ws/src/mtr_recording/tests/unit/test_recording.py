"""Recording: topics, size limit, decisions of a replay, and the layout for Foxglove."""
# SPDX-License-Identifier: Apache-2.0
import json
import math
import pathlib
import re
import signal
from types import SimpleNamespace

import pytest
import rosbag
import rospy
from genpy.dynamic import generate_dynamic
from geometry_msgs.msg import Twist

from mtr_core import names
from mtr_core.se2 import Pose2
from mtr_core.states import CarState
from mtr_msgs.msg import CarEstimate, LocalizedPose, MotionStatus, PeripheralsState, RobotMode, VelocityCommand
from mtr_recording import listening, mcap_file
from mtr_recording.bags import decisions_in, messages_in
from mtr_recording.command_line import compare, parsed, run, written_as_mcap
from mtr_recording.decisions import CarSeen, Decisions, differences
from mtr_recording.profiles import (
    FULL,
    ORDERS,
    PROFILES,
    RECORDED,
    REPLAYED,
    SMALL,
    CannotRecord,
    check_room,
    command_of,
    recorded_name,
)
from mtr_recording.relay import TYPES

LAUNCH = pathlib.Path(__file__).resolve().parents[5] / "launch"
LAYOUT = json.loads((LAUNCH / "foxglove" / "robot.json").read_text(encoding="utf-8"))
# Messages of which the layout shows single fields.
SHOWN = {names.ROBOT_MODE: RobotMode, names.MOTION_STATUS: MotionStatus, names.CAR_ESTIMATE: CarEstimate,
         names.LOCALIZED_POSE: LocalizedPose, recorded_name(names.PLANNER_VELOCITY): VelocityCommand,
         recorded_name(names.WHEEL_COMMAND): Twist, names.PERIPHERALS_STATE: PeripheralsState}
OWN_OUTPUTS = {names.ROBOT_MODE, names.MOTION_LOCK, names.LOCALIZED_POSE, names.CAR_ESTIMATE, names.CAR_CHECK,
               names.MAPPING_ORDER, names.SURFACE_MAP, "/tf"}


def test_full_has_what_small_has_and_all_that_is_replayed():
    assert set(SMALL) | set(REPLAYED) <= set(FULL)
    assert all(len(set(topics)) == len(topics) for topics in PROFILES.values())
    assert "/clock" not in FULL


def test_replay_plays_the_inputs_and_nothing_that_its_nodes_say_themselves():
    assert not OWN_OUTPUTS & set(REPLAYED)


def test_command_keeps_the_newest_within_the_limit():
    command = command_of("small", pathlib.Path("/data/small_1"), 400.0, lambda topic: topic.replace("/joy", "/pad"))
    assert command[:3] == ["rosrun", "rosbag", "record"]
    assert [topic.replace(RECORDED, "") for topic in command[-len(SMALL):]] == [
        "/pad" if topic == "/joy" else topic for topic in SMALL]
    size, parts = (int(next(word.partition("=")[2] for word in command if word.startswith(option)))
                   for option in ("--size", "--max-splits"))
    assert size * parts == 400


@pytest.mark.parametrize("profile", PROFILES)
def test_no_profile_records_an_order_under_its_own_name(profile):
    recorded = command_of(profile, pathlib.Path("/data/1"), 400.0, lambda topic: topic)
    assert not set(ORDERS) & set(recorded) and {recorded_name(names.JOY), recorded_name(names.WHEEL_COMMAND)} <= set(
        recorded)
    # Topics under their own name are rejected because of their stamps.
    assert set(recorded) & set(names.MOTION_INPUTS) <= {names.DESIRED_STATE, names.ROBOT_MODE}


def test_every_order_is_relayed_and_none_is_replayed():
    assert set(TYPES) == set(ORDERS) <= set(FULL) and not set(ORDERS) & set(REPLAYED)


def test_recording_that_does_not_fit_is_refused_with_what_to_do():
    check_room(pathlib.Path("/data"), 400.0, 1.5e9)
    with pytest.raises(CannotRecord, match="/data has 1300 MB free; .* needs 1400 MB. Make room"):
        check_room(pathlib.Path("/data"), 400.0, 1.3e9)


@pytest.mark.parametrize("arguments", [["--limit", "1"], ["--limit", "nan"], ["--profile", "all"],
                                       ["--out", "/no/where"]])
def test_options_that_cannot_be_are_refused(arguments, capsys):
    with pytest.raises(SystemExit) as caught:
        parsed(arguments)
    assert caught.value.code == 2 and "record: error: " in capsys.readouterr().err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_program_is_ended_as_by_ctrl_c_and_waited_for(number):
    before = {each: signal.getsignal(each) for each in (signal.SIGINT, signal.SIGTERM)}
    program = f"trap 'exit 3' INT; kill -{number.value} $PPID; while :; do sleep 0.05; done"
    try:
        assert run(["bash", "-c", program], lambda: True, "It runs.") == 3
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)


def test_program_is_said_to_run_when_it_does(tmp_path, monkeypatch):
    end, looks = tmp_path / "end", iter((False, False, True))
    monkeypatch.setattr("builtins.print", lambda *_, **__: end.touch() if next(looks, None) is None else None)
    program = f"for _ in $(seq 500); do [ -e {end} ] && exit 0; sleep 0.02; done; exit 5"
    assert run(["bash", "-c", program], lambda: next(looks), "It runs.") == 0


@pytest.mark.parametrize(("links", "is_heard"), [((), False), (("/a",), False), (("/a", "/b"), True)])
def test_recorder_listens_when_it_is_connected_with_every_publisher(links, is_heard, monkeypatch):
    state = ([["/scan", ["/a", "/b"]], ["/else", ["/a"]]], [["/scan", ["/record", "/c"]], ["/else", ["/c"]]], [])
    master = SimpleNamespace(getSystemState=lambda: state, lookupNode=lambda _: "http://127.0.0.1:1")
    info = [1, "", [[1, node, "i", "TCPROS", "/scan", True] for node in links] + [[2, "/c", "o", "TCPROS", "/rosout"]]]
    monkeypatch.setattr(listening.rosgraph, "Master", lambda _: master)
    monkeypatch.setattr(listening.xmlrpc.client, "ServerProxy", lambda _: SimpleNamespace(getBusInfo=lambda _: info))
    assert listening.is_listening("/record") is is_heard
    assert not listening.is_listening("/another")


def decided(shift_m=0.0, turn_deg=0.0, longer_m=0.0, last=CarState.LOCATED):
    """Return the decisions of one survey of the Car."""
    found = Decisions()
    pose = Pose2(3.0 + shift_m, 1.0, math.pi + math.radians(turn_deg))
    for state in (CarState.UNKNOWN, CarState.COLLECTING, CarState.COLLECTING, last, last):
        found.add_car(CarSeen(state, int(state == CarState.LOCATED), pose, 4.5 + longer_m, 1.8))
    for mode in (0, 1, 1, 2):
        found.add_mode(mode, True)
    return found


def test_each_decision_counts_once_while_it_lasts():
    found = decided()
    assert len(found.cars) == 3 and len(found.located) == 1 and found.modes == [(0, True), (1, True), (2, True)]


@pytest.mark.parametrize("replayed, words", [
    (decided(), None), (decided(shift_m=0.009, turn_deg=0.2, longer_m=0.009), None), (decided(shift_m=0.02), "2.0 cm"),
    (decided(turn_deg=0.5), "0.50 degrees"), (decided(longer_m=0.03), "size by 3.0 cm"),
    (decided(last=CarState.FAILED), "LOCATED 1 when recorded, and .* FAILED 0 when"),
    (Decisions(), "none when replayed")])
def test_what_was_decided_otherwise_is_told(replayed, words):
    found = " ".join(differences(decided(), replayed))
    assert (not found) if words is None else re.search(words, found)


@pytest.mark.parametrize(("begun_with", "is_same"), [(0, True), (1, True), (2, True), (3, False)])
def test_what_a_replay_decides_before_the_recording_began_does_not_count(begun_with, is_same):
    recorded, replayed = decided(), decided()
    replayed.modes = [(0, False), *replayed.modes]
    recorded.modes = [*recorded.modes, (3, True)][begun_with:]
    replayed.modes += [(3, True)] if is_same else [(3, False)]
    assert (not differences(recorded, replayed)) is is_same


def test_recording_without_decisions_proves_nothing():
    assert differences(Decisions(), Decisions())


def bag_at(path, shift_m=0.0):
    """Write a bag of a Car that was found."""
    with rosbag.Bag(str(path), "w") as bag:
        for number, state in enumerate((0, 1, 2)):
            time = rospy.Time(number + 1)
            car = CarEstimate(state=state, revision=state // 2, x=1.0 + shift_m, length=4.5)
            bag.write(names.CAR_ESTIMATE, car, time)
            bag.write(names.LOCALIZED_POSE, LocalizedPose(mode=state, valid=True), time)


def test_bags_are_compared_by_the_program(tmp_path, capsys):
    for name, shift_m in (("a", 0.0), ("b", 0.001), ("c", 0.1)):
        bag_at(tmp_path / f"{name}.bag", shift_m)
    recorded, same, other = (str(tmp_path / f"{name}.bag") for name in "abc")
    assert compare([recorded, "--replayed", same]) == 0
    assert compare([recorded, "--replayed", other]) == 1
    assert "10.0 cm" in capsys.readouterr().out
    assert len(decisions_in([tmp_path / "a.bag"]).cars) == 3
    assert compare([recorded, "--replayed", str(tmp_path / "none.bag")]) == 2


def test_mcap_has_every_message_with_its_definition(tmp_path, capsys):
    mcap_reader = pytest.importorskip("mcap.reader")
    bag_at(tmp_path / "small_1_0.bag")
    bag_at(tmp_path / "small_1_1.bag", 1.0)
    bag_at(tmp_path / "small_2_0.bag")
    assert written_as_mcap(tmp_path / "small_1") == 0
    assert capsys.readouterr().out.count(": 6 messages.") == 2
    assert sorted(path.name for path in tmp_path.glob("*.mcap*")) == ["small_1_0.mcap", "small_1_1.mcap"]
    with (tmp_path / "small_1_1.mcap").open("rb") as file:
        reader = mcap_reader.make_reader(file)
        assert reader.get_header().profile == "ros1"
        found = list(reader.iter_messages())
    assert [each[2].log_time for each in found] == sorted([1_000_000_000, 2_000_000_000, 3_000_000_000] * 2)
    schema, channel, message = next(each for each in reversed(found) if each[1].topic == names.CAR_ESTIMATE)
    assert (schema.name, schema.encoding, channel.message_encoding) == ("mtr_msgs/CarEstimate", "ros1msg", "ros1")
    # Only the content of the file is used.
    kinds = generate_dynamic(schema.name, schema.data.decode())
    car = kinds[schema.name]().deserialize(message.data)
    assert (car.state, car.revision, car.x, car.length) == (2, 1, 2.0, 4.5)


def test_mcap_of_a_bag_that_cannot_be_read_is_a_sentence_and_no_file(tmp_path, capsys):
    pytest.importorskip("mcap.writer")
    (tmp_path / "small_1_0.bag").write_bytes(b"no bag")
    assert written_as_mcap(tmp_path / "small_1") == 2
    assert "small_1_0.bag cannot be read" in capsys.readouterr().err and not list(tmp_path.glob("*.mcap"))


def test_without_the_library_mcap_is_refused_before_anything_is_recorded(monkeypatch):
    monkeypatch.setattr(mcap_file, "Writer", None)
    with pytest.raises(CannotRecord, match="pip install mcap"):
        mcap_file.check_mcap()


def panels(part):
    """Return the panels of the layout's tree."""
    return [part] if isinstance(part, str) else [*panels(part["first"]), *panels(part["second"])]


def test_layout_has_a_configuration_for_each_panel():
    assert sorted(panels(LAYOUT["layout"])) == sorted(LAYOUT["configById"])


def test_layout_shows_what_is_recorded():
    full = set(command_of("full", pathlib.Path("/data/1"), 400.0, lambda topic: topic))
    for config in LAYOUT["configById"].values():
        assert set(config.get("topics", ())) <= full
        paths = [each["value"] for each in config.get("paths", ())]
        paths += [config[key] for key in ("topicToRender", "topicPath") if key in config]
        for path in paths:
            topic, _, fields = path.partition(".")
            assert topic in full
            message = SHOWN[topic]() if fields else None
            for field in filter(None, fields.split(".")):
                message = getattr(message, field)


@pytest.mark.parametrize("content", [b"", b"#ROSBAG V2.0\n", b"#ROSBAG V2\x86.0\n" + bytes(4096),
                                     b"#ROSBAG V2.0\n" + b"\xff" * 64], ids=["empty", "begin", "no_text", "no_header"])
def test_damaged_bag_is_a_sentence_whatever_the_library_raises(tmp_path, content):
    path = tmp_path / "bad.bag"
    path.write_bytes(content)
    for read in (lambda: decisions_in([path]), lambda: list(messages_in(path))):
        with pytest.raises(CannotRecord, match=r"bad.bag cannot be read: .*\.$"):
            read()
