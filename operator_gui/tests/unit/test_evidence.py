"""A bundle of a test is signed and chained; any changed byte is found, and named where it is in a file."""
# SPDX-License-Identifier: Apache-2.0
import io
import json
import shutil
import zipfile
from xml.etree import ElementTree

import pytest
from mcap.reader import make_reader

from mtr_operator.cli import main
from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.verdict.limits_document import limits_from
from mtr_operator.evidence.adapters.junit import junit_of
from mtr_operator.evidence.adapters.ods import ods_of
from mtr_operator.evidence.adapters.openhtf import openhtf_of
from mtr_operator.evidence.bundle import bundle_path, write_bundle
from mtr_operator.evidence.manifest import sha256_of
from mtr_operator.evidence.record import SCHEMA, record_of
from mtr_operator.evidence.station_key import Station, StationKeyError
from mtr_operator.evidence.verification import chain_problems, verify_bundle
from mtr_operator.report.assessed import assess
from mtr_operator.report.files import FILE_NAMES
from mtr_operator.storage.progress_file import open_progress
from mtr_operator.storage.recorded.course_file import Moment, read_course


@pytest.fixture(name="measured", scope="module")
def measured_fixture(tmp_path_factory):
    """Folder of a test that was measured."""
    folder = tmp_path_factory.mktemp("measured") / "my_test"
    assert main(["demo", "key_press", "--out", str(folder)]) == 0
    return folder


@pytest.fixture(name="station")
def station_fixture(tmp_path):
    """A station of this test's own."""
    return Station(tmp_path / "station")


def bundled(measured, station, target):
    """Manifest of a bundle of the test."""
    scenario, _, progress = open_progress(measured / "progress.json", SCENARIOS)
    return write_bundle(target, measured / "progress.json", scenario, progress, None, profile="mtr_demo_car",
                        station=station)


@pytest.fixture(name="bundle")
def bundle_fixture(measured, station, tmp_path):
    """A bundle."""
    target = tmp_path / "a.mtr.zip"
    bundled(measured, station, target)
    return target


def test_bundle_holds_all_that_a_laboratory_keeps_and_is_intact(bundle, station):
    found = verify_bundle(bundle)
    assert found.is_intact and found.manifest.key == station.key and found.manifest.station == station.name
    assert {"record.json", "record.schema.json", "results.csv", "budget.json", "protocol.png", "protocol.pdf",
            "progress.json", "progress.journal", "parameters.json", "calibration.json", "plan.json", "versions.json",
            "recording/course_001.jsonl", "recording/course_001.mcap", "adapters/openhtf.json", "adapters/junit.xml",
            "adapters/ods.json", "car/mtr_demo_car.yaml", "car/mtr_demo_car.dbc"} <= set(found.manifest.files)


def test_report_in_a_bundle_is_that_of_the_progress_which_is_signed_whatever_lies_on_disk(measured, station, tmp_path):
    folder = shutil.copytree(measured, tmp_path / "test")
    report = {name: (folder / name).read_bytes() for name in FILE_NAMES}
    table = bytearray(report["results.csv"])
    table[-20] ^= 1
    (folder / "results.csv").write_bytes(bytes(table))
    (folder / "protocol.pdf").unlink()
    bundled(folder, station, tmp_path / "a.mtr.zip")
    with zipfile.ZipFile(tmp_path / "a.mtr.zip") as container:
        assert {name: container.read(name) for name in FILE_NAMES} == report


def test_part_of_the_report_that_cannot_be_made_is_left_out_and_named(measured, station, tmp_path, monkeypatch):
    def fail(*_):
        raise OutputError("No picture.")
    monkeypatch.setattr("mtr_operator.report.protocol_page.protocol_png", fail)
    bundled(measured, station, tmp_path / "a.mtr.zip")
    with zipfile.ZipFile(tmp_path / "a.mtr.zip") as container:
        assert json.loads(container.read("left_out.json")) == {"protocol.png": "No picture."}
        assert "protocol.png" not in container.namelist() and "protocol.pdf" in container.namelist()


def test_changed_byte_of_each_file_is_found_and_the_file_is_named(bundle, tmp_path):
    content = bundle.read_bytes()
    with zipfile.ZipFile(bundle) as container:
        places = {info.filename: info.header_offset + 30 + len(info.filename) + info.file_size // 2
                  for info in container.infolist()}
    for name, place in places.items():
        changed = tmp_path / "changed.mtr.zip"
        changed.write_bytes(content[:place] + bytes([content[place] ^ 1]) + content[place + 1:])
        found = verify_bundle(changed)
        assert not found.is_intact
        assert any(name in problem and "changed" in problem for problem in found.problems), (name, found.problems)


def test_any_changed_byte_between_the_files_is_found_too(bundle, tmp_path):
    content = bundle.read_bytes()
    with zipfile.ZipFile(bundle) as container:
        first, start = container.infolist()[0], container.start_dir
    changed = tmp_path / "changed.mtr.zip"
    for place in (*range(first.header_offset, first.header_offset + 30), *range(start, start + 46),
                  *range(len(content) - 22, len(content))):
        changed.write_bytes(content[:place] + bytes([content[place] ^ 1]) + content[place + 1:])
        assert not verify_bundle(changed).is_intact, place


@pytest.mark.parametrize("part", [0.0, 0.3, 0.9, 0.999])
def test_torn_bundle_is_told(bundle, tmp_path, part):
    torn = tmp_path / "torn.mtr.zip"
    torn.write_bytes(bundle.read_bytes()[:int(part * bundle.stat().st_size)])
    problem, = verify_bundle(torn).problems
    assert "is torn, or no bundle" in problem


def test_bundle_that_is_unpacked_is_verified_file_by_file(bundle, tmp_path):
    folder = tmp_path / "unpacked"
    with zipfile.ZipFile(bundle) as container:
        container.extractall(folder)
    assert verify_bundle(folder).is_intact
    (folder / "results.csv").unlink()
    (folder / "note.txt").write_text("added")
    (folder / "plan.json").write_text("[]")
    assert set(verify_bundle(folder).problems) == {"results.csv is missing.", "note.txt was added.",
                                                   "plan.json is changed."}


def test_manifest_of_another_key_is_no_signature_of_the_station(bundle, tmp_path):
    folder = tmp_path / "unpacked"
    with zipfile.ZipFile(bundle) as container:
        container.extractall(folder)
    manifest = folder / "manifest.json"
    manifest.write_text(manifest.read_text().replace('"number": 1', '"number": 2'))
    assert "the signature is not that of the station's key" in verify_bundle(folder).problems[0]
    signature = json.loads((folder / "manifest.sig").read_text())
    other = Station(tmp_path / "other")
    (folder / "manifest.sig").write_text(json.dumps({**signature, "key": other.key,
                                                     "signature": other.sign(manifest.read_bytes())}))
    assert "the signature is not that of the station's key" in verify_bundle(folder).problems[0]


def test_bundles_are_chained_and_one_that_was_made_anew_is_found(measured, station, tmp_path):
    paths = [tmp_path / f"{name}.mtr.zip" for name in "abc"]
    manifests = [bundled(measured, station, path) for path in paths]
    assert [manifest.number for manifest in manifests] == [1, 2, 3]
    assert manifests[2].before == sha256_of(manifests[1].content()) and manifests[0].before == ""
    found = [verify_bundle(path) for path in paths]
    assert chain_problems(found) == []
    station.append(type(station.newest)(1, "a", "0" * 64))
    bundled(measured, station, paths[1])
    problem, = chain_problems([verify_bundle(path) for path in paths[:2]])
    assert "Bundle 2 of the station does not follow its bundle 1" in problem


def test_command_line_says_by_whom_and_when_and_what_is_changed(bundle, station, tmp_path, capsys):
    assert main(["verify", str(bundle), "--key", station.key]) == 0
    said = capsys.readouterr().out
    assert "intact" in said and station.name in said and "with the key that is wanted" in said
    assert main(["verify", str(bundle), "--key", "0" * 64]) == 3
    other = tmp_path / "no.mtr.zip"
    other.write_bytes(b"nothing")
    assert main(["verify", str(bundle), str(other)]) == 3
    assert "is torn, or no bundle" in capsys.readouterr().err


def test_bundle_is_named_as_its_test(tmp_path):
    assert bundle_path(tmp_path / "my_test" / "progress.json").name == "my_test.mtr.zip"
    assert bundle_path(tmp_path / "autolock_1.json").name == "autolock_1.mtr.zip"


def test_bundle_that_cannot_be_written_leaves_nothing_and_no_link_of_the_chain(measured, station, tmp_path):
    with pytest.raises(OutputError, match="cannot be written"):
        bundled(measured, station, tmp_path / "none" / "a.mtr.zip")
    assert station.newest is None


def test_damaged_key_or_chain_is_named_and_not_replaced(tmp_path, station):
    before = station.key
    key = tmp_path / "station" / "signing.key"
    assert key.stat().st_mode & 0o077 == 0 and Station(tmp_path / "station").key == before
    key.write_text("damaged")
    with pytest.raises(StationKeyError, match="is damaged; restore it"):
        station.sign(b"")
    (tmp_path / "station" / "chain.json").write_text("{}")
    with pytest.raises(StationKeyError, match="chain of bundles"):
        _ = station.newest


KINDS = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "null": type(None)}


def violations(schema, value, place="record"):
    """What of the words of JSON Schema that the schema uses does not hold."""
    if "const" in schema and value != schema["const"]:
        yield place
    if "enum" in schema and value not in schema["enum"]:
        yield place
    kinds = schema.get("type", ())
    kinds = [kinds] if isinstance(kinds, str) else kinds
    if kinds and not any(isinstance(value, KINDS[kind]) for kind in kinds):
        yield place
    if isinstance(value, dict):
        yield from (f"{place}.{name}" for name in schema.get("required", ()) if name not in value)
        for name, each in value.items():
            inner = schema.get("properties", {}).get(name, schema.get("additionalProperties", {}))
            yield from violations(inner, each, f"{place}.{name}")
    if isinstance(value, list):
        for index, each in enumerate(value):
            yield from violations(schema.get("items", {}), each, f"{place}[{index}]")


def test_record_is_as_its_schema_says(bundle):
    schema = json.loads(SCHEMA.read_text())
    with zipfile.ZipFile(bundle) as container:
        record = json.loads(container.read("record.json"))
    assert list(violations(schema, record)) == []
    assert len(record["lines"]) >= 4
    assert list(violations(schema, {**record, "version": 2, "lines": [{}]}))


def record_in(bundle):
    """The record of a bundle."""
    with zipfile.ZipFile(bundle) as container:
        return json.loads(container.read("record.json"))


def test_verdict_of_the_record_is_a_word_of_its_schema(measured):
    scenario, parameters, progress = open_progress(measured / "progress.json", SCENARIOS)
    limits = limits_from({"limits": [{"what": "press", "at_least_m": 1000.0}]})
    progress.limits = limits
    record = record_of(scenario, progress, assess(scenario, parameters, progress))
    assert record["verdict"] == "fail"
    assert list(violations(json.loads(SCHEMA.read_text()), record)) == []
    assert openhtf_of(record, "here")["outcome"] == "FAIL"
    suite = ElementTree.fromstring(junit_of(record, "here"))
    assert suite.find("testcase[@name='verdict']/failure").get("message") == "fail"


def test_adapters_have_every_line_and_distance(bundle):
    record = record_in(bundle)
    lines, distance = record["lines"], record["lines"][0]["distances"][0]
    phases = openhtf_of(record, "here")["phases"]
    assert [phase["outcome"] for phase in phases] == len(lines) * ["PASS"]
    assert next(iter(phases[0]["measurements"].values()))["measured_value"] == distance["distance_m"]
    suite = ElementTree.fromstring(junit_of(record, "here"))
    assert suite.get("tests") == str(len(lines)) and suite.get("failures") == "0"
    columns = {each["name"]: each["values"] for each in
               ods_of(record, "here")["AoMeasurement"]["AoMeasurementQuantity"]}
    assert columns[f"{distance['word']}_distance_m"][0] == distance["distance_m"]
    assert {len(values) for values in columns.values()} == {len(lines)}


def test_equipment_of_ods_has_the_adapter_of_each_bus(bundle):
    record = record_in(bundle)
    adapters = {"CAN adapter": "slcan COM5", "CAN adapter of the bus body": "socketcan can1"}
    record["session"] = {**record["session"], **adapters, "CAN frames timed by": "the adapter"}
    equipment = ods_of(record, "here")["AoTestEquipment"]
    assert [each for each in equipment if each["name"].startswith("CAN")] == [
        {"name": name, "serial": text} for name, text in adapters.items()]


def test_line_that_is_invalid_has_failed_with_its_reason(bundle):
    record = record_in(bundle)
    record["lines"][0] = {**record["lines"][0], "reason": "a <door> was open"}
    assert openhtf_of(record, "here")["outcome"] == "ERROR"
    suite = ElementTree.fromstring(junit_of(record, "here"))
    assert suite.find("testcase/failure").get("message") == "a <door> was open"


def test_test_that_was_interrupted_is_not_passed(measured):
    scenario, parameters, progress = open_progress(measured / "progress.json", SCENARIOS)
    planned = len(progress.results)
    progress.results = progress.results[:2]
    record = record_of(scenario, progress, assess(scenario, parameters, progress))
    assert list(violations(json.loads(SCHEMA.read_text()), record)) == []
    test = openhtf_of(record, "here")
    assert test["outcome"] == "ERROR"
    assert [phase["outcome"] for phase in test["phases"]] == 2 * ["PASS"] + (planned - 2) * ["SKIP"]
    suite = ElementTree.fromstring(junit_of(record, "here"))
    assert (suite.get("tests"), suite.get("errors")) == (str(planned), str(planned - 2))
    assert suite.find("testcase[@name='radial 3']/error").get("message") == "The line was not measured."
    # Older records do not say what was planned.
    del record["planned_lines"]
    assert openhtf_of(record, "here")["outcome"] == "PASS"
    assert ElementTree.fromstring(junit_of(record, "here")).get("errors") == "0"


def test_course_is_in_the_bundle_as_foxglove_reads_it(bundle, measured):
    with zipfile.ZipFile(bundle) as container:
        content = container.read("recording/course_001.mcap")
    statuses = [each.status for each in read_course(measured / "recording" / "course_001.jsonl")
                if isinstance(each, Moment) and each.status.pose_valid]
    poses, kinds = [], set()
    for schema, channel, message in make_reader(io.BytesIO(content)).iter_messages():
        values = json.loads(message.data)
        if channel.topic == "/robot/pose":
            assert schema.name == "foxglove.PoseInFrame" and values["frame_id"] == "car"
            poses.append((message.log_time, values["pose"]["position"]))
        elif channel.topic == "/test/events":
            kinds.add(values["kind"])
    assert [place["x"] for _, place in poses] == [status.x for status in statuses]
    assert poses[-1][0] == round(statuses[-1].stamp_s * 1e9)
    assert {"expected", "watched"} <= kinds
