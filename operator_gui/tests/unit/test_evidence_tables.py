"""Results, poses and scans in a bundle: Parquet for analyses, MCAP for Foxglove; what is missing is said."""
# SPDX-License-Identifier: Apache-2.0
import base64
import io
import json
import struct
import sys
import zipfile

import pytest
from mcap.reader import make_reader

from mtr_operator.cli import main
from mtr_operator.domain.errors import OutputError, ProgressFileError
from mtr_operator.domain.results.course import Course
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.surroundings import Surroundings
from mtr_operator.evidence.adapters.mcap_file import mcap_of
from mtr_operator.evidence.adapters.parquet import parquet_of
from mtr_operator.evidence.adapters.tables import Table, poses_table, results_table
from mtr_operator.evidence.bundle import BundleWatch, write_bundle
from mtr_operator.evidence.station_key import Station
from mtr_operator.evidence.verification import verify_bundle
from mtr_operator.report.assessed import assess
from mtr_operator.storage.progress_file import open_progress
from mtr_operator.storage.recorded.course_file import CourseFile, Moment, read_course
from mtr_operator.storage.recorded.recording import recorded_runs
from mtr_operator.storage.recorded.scan_file import ScanFile, read_scans

duckdb = pytest.importorskip("duckdb")
SEEN = ((1.23, -2.0), (0.0, 3.5), (-4.0, 0.25))


class Watch(BundleWatch):
    """Keeps what it is told; stop_at: share at which it ends the writing."""

    def __init__(self, stop_at=2.0):
        self.missing, self.shares, self._stop_at = {}, [], stop_at

    def left_out(self, name, reason):
        self.missing[name] = reason

    def done(self, share):
        self.shares.append(share)
        if share >= self._stop_at:
            raise InterruptedError("the window closes")


def status(time_s, **changes):
    """With three returns, one metre beside the Car's front."""
    return RobotStatus(1, 1, time_s, **{"x": 3.0, "y": 1.0, "heading": 0.5, "pose_valid": True,
                                        "surroundings": Surroundings(SEEN), **changes})


@pytest.fixture(name="measured", scope="module")
def measured_fixture(tmp_path_factory):
    """Folder of a test that was measured, and scans of a robot with LiDARs beside its course."""
    folder = tmp_path_factory.mktemp("measured") / "my_test"
    assert main(["demo", "autolock", "--out", str(folder)]) == 0
    scans = ScanFile(folder / "recording" / "scans_001.jsonl", Course())
    scans.status(status(1.0), None)
    scans.status(status(2.5, pose_valid=False), None)
    scans.close()
    return folder


def bundled(measured, target, watch=None):
    """Path of a bundle of the test."""
    scenario, parameters, progress = open_progress(measured / "progress.json", SCENARIOS)
    write_bundle(target, measured / "progress.json", scenario, progress, assess(scenario, parameters, progress),
                 station=Station(target.parent / "station"), watch=watch)
    return target


def table_in(bundle, name, folder):
    """Rows of a Parquet file of a bundle, by the names of its columns."""
    with zipfile.ZipFile(bundle) as container:
        container.extract(name, folder)
    found = duckdb.execute(f"SELECT * FROM read_parquet('{folder / name}')")
    names = [column[0] for column in found.description]
    return [dict(zip(names, row)) for row in found.fetchall()]


def test_results_as_parquet_are_the_results_of_the_test(measured, tmp_path):
    rows = table_in(bundled(measured, tmp_path / "a.mtr.zip"), "results.parquet", tmp_path)
    _, _, progress = open_progress(measured / "progress.json", SCENARIOS)
    header = next(line for line in (measured / "results.csv").read_text().splitlines() if not line.startswith("#"))
    assert list(rows[0]) == header.split(",")
    assert [(row["axis"], row["side"], row["unlock_distance_m"], row["unlock_pass_distances_m"]) for row in rows] == [
        (each.axis, each.side, each.unlock_distance_m, list(each.unlock_pass_distances_m))
        for each in progress.results]
    assert {row["verdict"] for row in rows} == {"not_set"} and rows[0]["unlock_expanded_m"] > 0.0


@pytest.mark.parametrize("scenario", list(SCENARIOS))
def test_every_column_of_each_scenario_has_a_kind(scenario):
    table = results_table(SCENARIOS[scenario], Progress(scenario, {}), None)
    assert duckdb.from_parquet(io.BytesIO(parquet_of(table))).columns == list(table.columns)


def test_poses_as_parquet_are_those_of_the_course(measured, tmp_path):
    rows = table_in(bundled(measured, tmp_path / "a.mtr.zip"), "poses.parquet", tmp_path)
    statuses = [each.status for each in read_course(measured / "recording" / "course_001.jsonl")
                if isinstance(each, Moment)]
    assert [row["robot_time_s"] for row in rows] == [each.stamp_s for each in statuses]
    last, place = statuses[-1], statuses[-1].key_place
    assert (rows[-1]["x_m"], rows[-1]["heading_rad"], rows[-1]["run"]) == (last.x, last.heading, 1)
    assert (rows[-1]["key_x_m"], rows[-1]["key_y_m"]) == place


def test_pose_that_was_not_known_is_no_place(tmp_path):
    course = CourseFile(tmp_path / "course_001.jsonl")
    course.status(status(1.0, pose_valid=False), None)
    course.close()
    row, = poses_table([course.path]).rows
    assert row[:6] == [1, 1.0, False, None, None, None]


def test_bundle_without_the_package_says_what_is_left_out_and_why(measured, tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "duckdb", None)
    # The command's station is this test's own, too.
    monkeypatch.setattr("platformdirs.user_data_path", lambda *_, **__: tmp_path / "data")
    watch = Watch()
    bundle = bundled(measured, tmp_path / "a.mtr.zip", watch)
    assert set(watch.missing) == {"results.parquet", "poses.parquet"}
    with zipfile.ZipFile(bundle) as container:
        assert json.loads(container.read("left_out.json")) == watch.missing
        assert not [name for name in container.namelist() if name.endswith(".parquet")]
    assert verify_bundle(bundle).is_intact
    assert main(["bundle", str(measured), "--out", str(tmp_path / "b.mtr.zip")]) == 0
    assert "without results.parquet: The package duckdb is not installed; pip install duckdb" in capsys.readouterr().out


def test_table_that_cannot_be_made_is_a_sentence():
    with pytest.raises(OutputError, match="It cannot be made: "):
        parquet_of(Table({"a": "NO_KIND"}, [[1]]))


def test_damaged_course_is_bundled_alone_and_named(measured, tmp_path):
    copy = tmp_path / "copy"
    (copy / "recording").mkdir(parents=True)
    (copy / "progress.json").write_bytes((measured / "progress.json").read_bytes())
    (copy / "recording" / "course_001.jsonl").write_text("[]\n")
    watch = Watch()
    assert verify_bundle(bundled(copy, tmp_path / "a.mtr.zip", watch)).is_intact
    assert set(watch.missing) == {"recording/course_001.mcap", "poses.parquet"}
    assert "is damaged in line 1" in watch.missing["poses.parquet"]


def test_writing_tells_how_far_it_is_and_ends_when_it_has_to(measured, tmp_path):
    watch = Watch()
    bundled(measured, tmp_path / "a.mtr.zip", watch)
    assert watch.shares == sorted(watch.shares) and watch.shares[-1] == 1.0 and len(watch.shares) > 20
    with pytest.raises(OutputError, match="the window closes"):
        bundled(measured, tmp_path / "b.mtr.zip", Watch(stop_at=0.7))
    assert [path.name for path in tmp_path.glob("*b.mtr.zip*")] == []
    assert Station(tmp_path / "station").newest.number == 1


def test_scans_are_in_the_bundle_as_foxglove_reads_them(measured, tmp_path):
    with zipfile.ZipFile(bundled(measured, tmp_path / "a.mtr.zip")) as container:
        content = container.read("recording/course_001.mcap")
        assert "recording/scans_001.jsonl" in container.namelist()
    messages = make_reader(io.BytesIO(content)).iter_messages(topics=["/lidar/points"])
    found = [(schema, json.loads(message.data)) for schema, _, message in messages]
    schema, first = found[0]
    assert schema.name == "foxglove.PointCloud" and len(found) == 2
    assert json.loads(schema.data)["properties"]["data"]["contentEncoding"] == "base64"
    data = base64.b64decode(first["data"])
    assert [field["name"] for field in first["fields"]] == ["x", "y"] and first["point_stride"] == 8
    points = list(struct.iter_unpack("<2f", data))
    assert points == [pytest.approx(point, abs=1e-6) for point in SEEN]
    assert (first["frame_id"], first["pose"]["position"]) == ("car", {"x": 3.0, "y": 1.0, "z": 0.0})
    assert (found[1][1]["frame_id"], found[1][1]["timestamp"]) == ("base_link", {"sec": 2, "nsec": 500_000_000})


def test_messages_of_a_course_with_scans_are_in_the_order_of_time(measured):
    run, = recorded_runs(measured / "recording")
    times = [message.log_time for _, _, message in make_reader(io.BytesIO(
        mcap_of(run.course, list(read_scans(run.scans))))).iter_messages(log_time_order=False)]
    assert times == sorted(times)


def test_one_scan_a_second_is_kept_and_one_after_the_clock_was_set_back(tmp_path):
    scans = ScanFile(tmp_path / "recording" / "scans_001.jsonl", Course())
    for tenth in range(25):
        scans.status(status(10.0 + tenth / 10.0), None)
    scans.status(status(11.0), None)
    scans.status(status(20.0, surroundings=None), None)
    scans.status(status(21.0, surroundings=Surroundings()), None)
    scans.close()
    assert [scan.time_s for scan in read_scans(scans.path)] == [10.0, 11.0, 12.0, 11.0]
    assert next(read_scans(scans.path)) == (10.0, (3.0, 1.0, 0.5), SEEN)


def test_scans_have_a_limit_and_a_full_disk_ends_them_and_no_test(tmp_path):
    class Kept(Course):
        """Counts."""

        statuses = 0

        def status(self, status, mark):
            Kept.statuses += 1

    scans = ScanFile(tmp_path / "scans_001.jsonl", Kept(), max_bytes=100)
    for second in range(5):
        scans.status(status(float(second)), None)
    scans.close()
    assert "; those after 2 s of robot time are not kept." in scans.problem and Kept.statuses == 5
    assert len(list(read_scans(scans.path))) == 2
    (tmp_path / "file").write_text("")
    scans = ScanFile(tmp_path / "file" / "scans.jsonl", Kept())
    scans.status(status(1.0), None)
    assert "are not kept in" in scans.problem


def test_torn_scans_are_read_up_to_there_and_damaged_ones_are_refused(tmp_path):
    path = tmp_path / "scans.jsonl"
    path.write_text('["mtr-operator scans",1]\n[1.0,null,[100,200]]\n[2.0,nul')
    assert [scan.points for scan in read_scans(path)] == [((1.0, 2.0),)]
    for text in ("[]\n", '["mtr-operator scans",2]\n', '["mtr-operator scans",1]\n[1.0]\n',
                 '["mtr-operator scans",1]\n[1.0,null,["a"]]\n'):
        path.write_text(text)
        with pytest.raises(ProgressFileError, match="are damaged in line"):
            list(read_scans(path))
    with pytest.raises(ProgressFileError, match="cannot be read"):
        list(read_scans(tmp_path / "none"))
