"""Command mtr-results: output for persons and programs, exit codes, and error sentences."""
# SPDX-License-Identifier: Apache-2.0
import json

import measured
import pytest

from mtr_operator.domain.identity.identity import Identity
from mtr_results.cli import main

GOLF = Identity("WVW1", "Golf", "SW 7", key_serial="0042")


@pytest.fixture
def run(place, capsys):
    """Return a function that runs a command on an empty store and returns exit code, output and error output."""
    def command(name, *arguments):
        on_store = () if name == "query" else ("--store", place.address)
        spool = ("--spool", str(place.spool)) if name == "import" else ()
        status = main([name, *on_store, *spool, *map(str, arguments)])
        said = capsys.readouterr()
        return status, said.out, said.err
    return command


@pytest.fixture
def two_tests(run, tmp_path):
    """Import two tests: 1 with limits and an identity, 2 with a journal."""
    measured.in_folder(tmp_path / "tests" / "one", 5.0, 5.5, 6.0, 6.5, identity=GOLF)
    measured.journalled(tmp_path / "tests" / "two", [5.0, 5.5], mark="b2")
    status, out, err = run("import", tmp_path / "tests", "--campaign", "winter")
    assert status == 0 and out.count("added: ") == 2 and not err


@pytest.mark.usefixtures("two_tests")
def test_list_and_show_tell_a_person_and_a_program_the_same(run):
    _, out, _ = run("list", "golf")
    assert "Golf WVW1" in out and len(out.splitlines()) == 2
    status, out, _ = run("list", "--json", "--campaign", "winter", "--limit", "1")
    row, = json.loads(out)
    assert status == 0 and row["campaign"] == "winter"
    assert "1 more fit" in run("list", "--limit", "1")[1]
    number = next(row["id"] for row in json.loads(run("list", "--json")[1]) if row["test_key"] == "b2")
    _, out, _ = run("show", "b2", "--trials")
    assert "radial 1 (0\N{DEGREE SIGN})" in out and "5.500" in out and out.count("not_reached") == 2
    shown = json.loads(run("show", number, "--json")[1])
    assert len(shown["trials"]) == 6 and shown["test_key"] == "b2" and shown["measurements"][1]["first_m"] == 5.5


def test_import_names_each_file_that_is_none_and_takes_the_others(run, tmp_path):
    measured.in_folder(tmp_path / "tests" / "one", 5.0)
    (tmp_path / "tests" / "two").mkdir()
    (tmp_path / "tests" / "two" / "progress.json").write_text("{}")
    status, out, err = run("import", "--json", tmp_path / "tests", tmp_path / "nowhere")
    assert status == 2 and not err
    assert sorted(each["outcome"] for each in json.loads(out)) == ["added", "refused", "refused"]
    path = tmp_path / "tests" / "one" / "progress.json"
    assert run("import", path.parent)[:2] == (0, f"known: {path}\n")


def test_file_that_calls_itself_a_bundle_is_refused_in_words(run, tmp_path):
    bundle = tmp_path / "one.mtr.zip"
    bundle.write_bytes(b"PK")
    status, _, err = run("import", bundle)
    assert status == 2 and "is torn, or no bundle" in err


def test_empty_folder_unknown_test_and_wrong_address_are_one_sentence(run, tmp_path, capsys):
    assert "holds no test" in run("import", tmp_path)[2]
    status, out, err = run("show", "77")
    assert (status, out) == (2, "") and err.count("\n") == 1 and "mtr-results list" in err
    assert main(["list", "--store", "oracle://me:secret@host/lab"]) == 2
    said = capsys.readouterr().err
    assert "is no address of a store" in said and "secret" not in said


@pytest.mark.usefixtures("two_tests")
def test_exported_tables_hold_every_row_and_answer_queries(run, tmp_path):
    folder = tmp_path / "tables"
    counts = json.loads(run("export", folder, "--json")[1])
    assert (counts["test"], counts["trial"], counts["measurement"]) == (2, 26, 6)
    assert {path.name for path in folder.iterdir()} == {f"{name}.parquet" for name in counts}
    status, out, _ = run("query", folder, "SELECT test_id, count(*) AS n, max(high_m) AS high_m FROM measurement "
                                          "WHERE is_current GROUP BY 1 ORDER BY n", "--json")
    few, many = json.loads(out)
    assert status == 0 and (few["n"], many["n"]) == (1, 4) and many["high_m"] == pytest.approx(6.8, abs=0.02)
    assert run("query", folder, "SELECT nonsense")[0] == 2 == run("query", tmp_path / "empty", "SELECT 1")[0]


@pytest.fixture
def two_sets(run, tmp_path):
    """Import three tests of key A, and three of key B, whose range is 0.7 m shorter."""
    for key, base_m in (("A", 5.6), ("B", 4.9)):
        for number, more_m in enumerate((0.0, 0.05, -0.05)):
            distances_m = [base_m + more_m + 0.01 * line for line in range(4)]
            measured.in_folder(tmp_path / "tests" / f"{key}{number}", *distances_m, mark=f"{key}{number}",
                               started=f"2026-11-2{number}T10:00:0{number}Z" if key == "A" else
                               f"2026-11-2{number}T11:00:00+00:00", identity=Identity(key_serial=key))
    assert run("import", tmp_path / "tests")[0] == 0


@pytest.mark.usefixtures("two_sets")
def test_compare_of_two_sets_and_of_two_tests(run):
    status, out, _ = run("compare", "key=A", "key=B")
    assert status == 0 and out.count("nearer *") == 6 and "Different among all (Holm)" in out
    found = json.loads(run("compare", "key=A", "key=B", "--json")[1])
    assert found["is_different"] and found["rows"][0]["difference"] == pytest.approx(-0.7)
    assert [row["quantity"] for row in found["rows"]] == ["distance"] * 4 + ["side", "area"]
    assert "No difference is shown" in run("compare", "A0", "A1")[1]
    assert "No test fits" in run("compare", "key=A", "key=C")[2]
    assert "NAME=VALUE" in run("compare", "colour=red", "A0")[2]


@pytest.mark.usefixtures("two_sets")
def test_spread_and_trend_of_each_distance(run):
    out = run("spread", "scenario=key_press", "--by", "key,car", "--line", "1")[1]
    assert "6 tests, 0 without a value" in out and "key (2): " in out and "car: all tests have the same one" in out
    spread = json.loads(run("spread", "scenario=key_press", "--json", "--line", "1")[1])[0]
    assert spread["repeatability_m"] == pytest.approx(0.05, rel=1e-2)
    assert spread["reproducibility_m"] > 0.4 and "cpk" not in spread
    limited = ("spread", "scenario=key_press", "--by", "key,car", "--line", "1", "--at-least", "4")
    out = run(*limited)[1]
    assert "Cpk, by repeatability: 8.33, 95 % " in out and "Ppk, by reproducibility: 0." in out
    assert json.loads(run(*limited, "--json")[1])[0]["cpk"]["value"] == pytest.approx(1.25 / 0.15, rel=1e-2)
    found = json.loads(run("trend", "scenario=key_press", "--json")[1])
    assert len(found["tests"]) == 6 and len(found["distances"]) == 4
    assert "mean 5.250 m" in run("trend", "scenario=key_press", "--line", "1")[1]


def test_upgrade_of_a_new_store_makes_it(run):
    status, out, _ = run("upgrade")
    assert status == 0 and "has the version of this program" in out
