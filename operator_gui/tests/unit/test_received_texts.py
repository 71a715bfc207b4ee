"""Each text of a received document is replaced by what does harm where it is trusted; then all is done with the test
that an Operator and a laboratory do with one. Nothing is written elsewhere, asked of the network, or ends in a
traceback."""
# SPDX-License-Identifier: Apache-2.0
import collections
import csv
import datetime
import hashlib
import json
import re

import measured
import pytest
import yaml
from asgi import asked
from received import ALL_VALUES, KEY, Sandbox, cases, changed, no_requests, place_text, texts, values

from mtr_campaign.plan.plan import load_plan
from mtr_operator.car_link.profile import PROFILE_FOLDER, bundled_files, load_profile
from mtr_operator.cli import main as operator_main
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.identity.identity import Equipment, Identity, Photo
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.domain.verdict.limits_document import limits_from
from mtr_operator.evidence.bundle import write_bundle
from mtr_operator.evidence.station_key import Station
from mtr_operator.evidence.verification import verify_bundle
from mtr_operator.history.reading import read_entry
from mtr_operator.report.files import write_report
from mtr_operator.station.settings_file import SettingsStore
from mtr_operator.station.test import open_test, report_folder
from mtr_operator.storage.given_files import load_calibration, load_limits
from mtr_operator.storage.identity_file import load_identity
from mtr_operator.storage.journal.journal_file import Entry, journal_path, line_of, read_journal
from mtr_operator.storage.photos import copy_photos, keep_photos, photo_folder
from mtr_operator.storage.progress_file import open_progress, save_progress
from mtr_results.cli import main as results_main
from mtr_results.laboratory import ResultsLaboratory
from mtr_results.live.followed import Followed
from mtr_results.live.watch import Watch
from mtr_results.store.place import Place
from mtr_results.web.application import application
from mtr_results.web.live_pages import LivePages
from mtr_results.web.pages import Pages

PHOTO = Photo("car.jpg", hashlib.sha256(b"picture").hexdigest())
WHO = Identity("VIN1", "Golf", "0412", "0042", "remote", 3.02, "J. Novak", "Hall 2", "dry", "Doors shut.",
               (Equipment("multimeter", "77", datetime.date(2026, 3, 1)),), (PHOTO,))
LIMITS = {"limits": [{"name": "near", "what": "press", "at_least_m": 6.0, "sides": ["left", "right"]}]}
# What a page would hold if a text were not text.
MARKUP = re.compile(r"<(b|script|img)\b(?![^>]*class=)|href=\"(http|//)|src=\"(http|//)")


@pytest.fixture
def sandbox(tmp_path, monkeypatch):
    """A home in which one folder may be written; the network may not be asked."""
    made = Sandbox(tmp_path, monkeypatch)
    with no_requests(monkeypatch):
        yield made
    made.check()


def record(folder, name="received", **changes):
    """Path of the record of a test with all that a person may say of one."""
    invalid = KeyPressResult(3, 180.0, LineStatus.INVALID, None, None, None, 0, 1.0, "The Car was opened by hand.")
    path = measured.in_folder(folder / name, 5.0, 5.5, invalid, identity=WHO, limits=limits_from(LIMITS),
                              calibration=load_calibration(), **changes)
    (path.parent / "photos").mkdir()
    (path.parent / "photos" / PHOTO.name).write_bytes(b"picture")
    return path


def refused(error):
    """A refusal is one sentence that can be read."""
    sentence = str(error)
    # Shown in part: pytest would quote all of it.
    assert 0 < len(sentence) < 2000, sentence[:300]
    assert "Traceback" not in sentence, sentence[:300]


def accepted(document, root, read):
    """Lists of pairs of a place and a text with which a document is read, each place once in a list."""
    found, rounds = collections.defaultdict(list), collections.Counter()
    hostile = values(root)
    # As it was it is read.
    read(document)
    for place, name in cases(document, root):
        try:
            read(changed(document, (place, hostile[name])))
        except OperatorError as error:
            refused(error)
        # The place of the text is what a person needs who mends it.
        except Exception as error:
            raise AssertionError(f"{place_text(place)} as {name}: {type(error).__name__}: {error}"[:500]) from error
        else:
            found[rounds[place]].append((place, hostile[name]))
            rounds[place] += 1
    return list(found.values())


def together(document, changes):
    """The document with all of the texts; longer places first, so that keys are renamed after what is below them."""
    # A key is renamed after its value is changed: both places have keys in common, and KEY is one more.
    return changed(document, *sorted(changes, key=lambda change: (len(change[0]) - (change[0][-1] is KEY),
                                                                  change[0][-1] is not KEY), reverse=True))


@pytest.mark.timeout(900 if ALL_VALUES else 300)
def test_each_text_of_a_record_is_text_wherever_it_is_shown(sandbox, capsys):
    path = record(sandbox.chosen)
    document = json.loads(path.read_text(encoding="utf-8"))

    def read(each):
        path.write_text(json.dumps(each), encoding="utf-8")
        open_progress(path, SCENARIOS)
        open_test(path)
    found = accepted(document, sandbox.root, read)
    assert sum(map(len, found)) > 20
    clean = record(sandbox.chosen, "clean", mark="other")
    for number, changes in enumerate(found):
        read(together(document, changes))
        everything(path, clean, sandbox, number, capsys)


def everything(path, clean, sandbox, name, capsys):
    """All that is done with a test."""
    out = sandbox.chosen / f"out_{name}"
    out.mkdir()
    scenario, parameters, progress = open_progress(path, SCENARIOS)
    problems = []
    write_report(out, scenario, parameters, progress, problems.append)
    assert not problems
    folder = report_folder(sandbox.chosen, open_test(path))
    assert folder.parent == sandbox.chosen
    save_progress(out / "progress.json", progress)
    if progress.identity is not None:
        copy_photos(progress.identity.photos, photo_folder(path), photo_folder(out / "progress.json"))
    check_table(out / "results.csv")
    write_bundle(out / "a.mtr.zip", path, scenario, progress, None, profile=progress.session.get("car profile", ""),
                 station=Station(sandbox.chosen / "station"))
    assert verify_bundle(out / "a.mtr.zip").is_intact
    assert not read_entry(out / "a.mtr.zip").problem
    stored(out / "a.mtr.zip", clean, sandbox, out)
    for arguments in (["history", "--folder", str(out)], ["compare", str(path), str(clean)], ["bundle", str(path)]):
        assert operator_main(arguments) in (0, 1, 2, 3)
    capsys.readouterr()


def check_table(path):
    """No cell of a table is what a spreadsheet computes."""
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.reader(line for line in file if not line.startswith("#")):
            assert not [cell for cell in row if cell.lstrip()[:1] in ("=", "@") or cell[:1] in "\t\r" and cell], row


def stored(path, clean, sandbox, out):
    """Into a store, out of it again, and on its pages."""
    place = Place(str(out / "store.sqlite"), spool=out / "spool")
    door = place.door()
    assert door.take(clean).outcome == "added"
    taken = door.take(path, campaign="a")
    if taken.outcome == "refused":
        refused(taken.sentence)
        return
    laboratory = ResultsLaboratory(place)
    for number, entry in enumerate(laboratory.entries()):
        fetched = out / f"fetched_{number}"
        fetched.mkdir()
        laboratory.fetch(entry, fetched / "progress.json")
    database = place.open()
    app = application(Pages(database, place.kept_files()), LivePages(Watch(Followed([out]), database)))
    files = json.loads(asked(app, "/tests/2.json")[1])["files"]
    for address in ("/", "/tests/2", "/report/2.html", "/compare?first=1&second=2", "/trend?set=1,2", "/live",
                    *(f"/tests/2/files/{file['name']}" for file in files)):
        status, content = asked(app, address)
        assert status == 200, (address, content[:500])
        assert "/files/" in address or not MARKUP.search(content.decode()), address
    database.close()
    for arguments in (["list"], ["show", "2"], ["compare", "1", "2"], ["report", "2", "--out", str(out / "r.html")]):
        assert results_main([*arguments, "--store", place.address]) == 0


def test_each_text_of_a_journal_is_text(sandbox):
    path = measured.journalled(sandbox.chosen / "received", (5.0,))
    entries = [[entry.sequence, entry.kind, dict(entry.values)] for entry in read_journal(journal_path(path)).entries]

    def read(each):
        lines = [line_of(Entry(*entry)) for entry in each]
        journal_path(path).write_bytes(b"".join(lines))
        # Alone, so that it counts whatever it says.
        open_progress(journal_path(path), SCENARIOS)
        read_entry(path)
    path.unlink()
    accepted(entries, sandbox.root, without_surrogates(read))


def without_surrogates(read):
    """A journal is UTF-8, in which there is no half of a character."""
    def reading(document):
        if "\\ud8" not in json.dumps(document):
            read(document)
    return reading


@pytest.mark.parametrize("name", ["mtr_demo_car", "mtr_honest_car"])
def test_each_text_of_a_profile_is_text(sandbox, name):
    folder = sandbox.chosen / "car"
    folder.mkdir()
    for suffix in ("yaml", "dbc"):
        (folder / f"{name}.{suffix}").write_bytes((PROFILE_FOLDER / f"{name}.{suffix}").read_bytes())
    path = folder / "received.yaml"
    document = yaml.safe_load((folder / f"{name}.yaml").read_text(encoding="utf-8"))

    def read(each):
        path.write_text(yaml.safe_dump(each), encoding="utf-8")
        files, _ = bundled_files(str(path))
        assert {file.parent for file in files.values()} <= {folder, PROFILE_FOLDER}
        load_profile(str(path))
    accepted(document, sandbox.root, read)


@pytest.mark.parametrize("kind", ["identity", "limits", "calibration", "plan"])
def test_each_text_of_a_given_file_is_text(sandbox, kind):
    path = sandbox.chosen / f"{kind}.yaml"
    (sandbox.chosen / "car.jpg").write_bytes(b"picture")
    document = {"identity": {**json.loads(json.dumps(WHO.to_document())), "photos": ["car.jpg"]}, "limits": LIMITS,
                "calibration": json.loads(json.dumps(load_calibration().to_document(), default=str)),
                "plan": {"name": "winter", "kernel": "radio", "scenario": "key_press", "design": {"kind": "grid"},
                         "set": {"car": "honest"}, "vary": {"seed": [1, 2], "place": ["a", "b"]}}}[kind]

    def read(each):
        path.write_text(yaml.safe_dump(each), encoding="utf-8")
        if kind == "identity":
            given = load_identity(path)
            keep_photos(given.photos, sandbox.chosen / "photos")
        else:
            {"limits": load_limits, "calibration": load_calibration, "plan": load_plan}[kind](path)
    accepted(document, sandbox.root, read)


def test_each_text_of_the_settings_is_text(sandbox):
    path = sandbox.chosen / "settings.json"
    SettingsStore(path).change(SettingsStore(path).settings)
    document = json.loads(path.read_text(encoding="utf-8"))
    assert [*texts(document)]

    def read(each):
        path.write_text(json.dumps(each), encoding="utf-8")
        assert SettingsStore(path).settings
    accepted(document, sandbox.root, read)
