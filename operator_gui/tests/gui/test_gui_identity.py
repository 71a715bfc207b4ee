"""Car, key, operator and equipment before the start: asked once, required by the laboratory, kept with the test."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import hashlib

import pytest

from mtr_operator.domain.identity.identity import Equipment, Identity, Photo
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.gui.pictures.export import pdf, svg
from mtr_operator.gui.pictures.identity_tables import identity_table, signed
from mtr_operator.gui.pictures.protocol_picture import Protocol
from mtr_operator.gui.pictures.protocol_sheet import ProtocolSheet
from mtr_operator.gui.screens.annotation_dialog import AnnotationDialog
from mtr_operator.storage.lock import Lock
from mtr_operator.storage.progress_file import open_progress

REQUIRED = "required: [car_vin, operator]\ndefaults: {place: Hall 2}\n"


@pytest.fixture
def laboratory(settings_path):
    """laboratory(text) writes the laboratory's file."""
    return lambda text: settings_path.with_name("laboratory.yaml").write_text(text, encoding="utf-8")


def enter(form, **texts):
    for name, text in texts.items():
        form.fields[name].show_text(text)


def test_test_starts_only_with_what_the_laboratory_requires(operator, laboratory):
    laboratory(REQUIRED)
    screen = operator.choose("key_press")
    form = screen.identity
    operator.wait(lambda: operator.model.readiness.can_start)
    assert form.more.isChecked() and form.fields["place"].text == "Hall 2"
    assert form.fault.text() == "The laboratory requires: Car's VIN, Operator." and not screen.start.isEnabled()
    enter(form, car_vin="WVW1", operator="Nov\u00e1k")
    assert not form.fault.isVisible()
    operator.wait(screen.start.isEnabled)
    enter(form, key_battery_v="75")
    assert "allowed is 0 to 60 V" in form.fields["key_battery_v"].fault and not screen.start.isEnabled()
    enter(form, key_battery_v="3,02")
    operator.wait(screen.start.isEnabled)


def test_damaged_file_of_the_laboratory_keeps_tests_from_starting(operator, laboratory):
    laboratory("required: [car]\n")
    screen = operator.choose("key_press")
    assert "laboratory.yaml" in screen.identity.fault.text() and "'car' is unknown" in screen.identity.fault.text()
    assert not screen.start.isEnabled()


def test_identity_and_photos_are_in_the_record_and_the_report_and_are_asked_once(operator, tmp_path):
    photo = tmp_path / "Car.JPG"
    photo.write_bytes(b"picture")
    form = operator.choose("key_press").identity
    enter(form, car_vin="WVW1", key_serial="0042", notes="Doors shut.", weather="rain",
          equipment="multimeter; 77; 2026-03-01")
    form.photos.show_paths((photo,))
    operator.window.settings["key_press"].form.fields["angle_between_radials_rad"].edit.setText("90")
    operator.wait(operator.window.settings["key_press"].start.isEnabled)
    operator.click(operator.window.settings["key_press"].start)
    protocol = operator.finish()
    operator.wait(protocol.show_folder.isEnabled)
    record = operator.model.current_test.path
    identity = open_progress(record, SCENARIOS)[2].identity
    assert identity.photos == (Photo("Car.jpg", hashlib.sha256(b"picture").hexdigest()),)
    assert (identity.car_vin, identity.notes) == ("WVW1", "Doors shut.")
    assert (record.with_name(f"{record.stem}.photos") / "Car.jpg").read_bytes() == b"picture"
    report = tmp_path / "results" / record.stem
    assert (report / "photos" / "Car.jpg").read_bytes() == b"picture"
    assert "# identity key_serial: 0042" in (report / "results.csv").read_text(encoding="utf-8")
    operator.click(protocol.done)
    form = operator.choose("key_press").identity
    texts = {name: field.text for name, field in form.fields.items()}
    assert (texts["car_vin"], texts["weather"], texts["notes"]) == ("WVW1", "rain", "") and form.photos.paths == ()
    assert form.summary.text() == "WVW1, 0042" and not form.more.isChecked()
    # Another start, on another day.
    store = operator.application.flow.store
    store.load()
    store.settings = dataclasses.replace(store.settings, identity_day="2020-01-01")
    form.propose(store)
    assert form.fields["car_vin"].text == "WVW1" and form.fields["weather"].text == ""


def test_protocol_has_a_page_with_the_identity_and_lines_to_sign_on(operator, opener):
    operator.begin("key_press")
    operator.finish()
    test = operator.model.current_test
    plain = Protocol(test.scenario, test.parameters, test.progress)
    assert identity_table(plain) == []
    who = Identity("WVW1", operator="Nov\u00e1k", key_battery_v=3.0, notes="One.\nTwo.",
                   equipment=(Equipment("multimeter", "77"),))
    known = Protocol(test.scenario, test.parameters, dataclasses.replace(test.progress, identity=who))
    texts = [tuple(cell[0] for cell in row.cells) for row in identity_table(known)]
    assert ("Car's VIN", "WVW1") in texts and ("Notes", "One.") in texts and ("", "Two.") in texts
    pages = signed([[]], known, 40)
    assert [row.cells[0][0] for row in pages[-1] if row.is_signed] == ["Nov\u00e1k", ""]
    assert len(signed([40 * [pages[-1][0]]], known, 40)) == 2, "a full page gets no signatures"
    assert pdf(ProtocolSheet(known)).startswith(b"%PDF") and b"WVW1" in svg(ProtocolSheet(known))


def test_car_of_before_is_taken_up_by_its_vin_with_its_key(operator):
    store = operator.application.flow.store
    golf = Identity("WVW1", "Golf", "0412", key_serial="0042", key_type="remote", operator="J. Novak")
    store.change(store.settings.with_car(golf).with_car(Identity("TMB2", "Octavia", key_serial="0007")))
    form = operator.choose("key_press").identity
    completer = form.fields["car_vin"].edit.completer()
    completer.setCompletionPrefix("vw")
    assert completer.completionCount() == 1
    enter(form, place="Hall 2", car_vin="WVW1")
    texts = {name: form.fields[name].text for name in ("car_model", "car_software", "key_serial", "key_type", "place")}
    assert texts == {"car_model": "Golf", "car_software": "0412", "key_serial": "0042", "key_type": "remote",
                     "place": "Hall 2"}
    # What is put right afterwards stays.
    enter(form, key_serial="0043")
    assert form.given.identity.key_serial == "0043"
    enter(form, car_vin="TMB2")
    assert form.given.identity.car_model == "Octavia" and form.given.identity.key_serial == "0007"


def annotated(protocol, operator, notes, *photos):
    """Have notes and photos added to the test that the protocol shows."""
    operator.wait(protocol.annotate.isEnabled)
    operator.click(protocol.annotate)
    dialog = next(each for each in protocol.findChildren(AnnotationDialog) if each.isVisible())
    assert not dialog.keep.isEnabled()
    dialog.notes.show_text(notes)
    dialog.photos.show_paths(photos)
    return dialog


def test_notes_and_photos_added_after_a_test_are_in_record_protocol_and_files(operator, tmp_path):
    before, after = tmp_path / "car.jpg", tmp_path / "more" / "car.jpg"
    after.parent.mkdir()
    before.write_bytes(b"before")
    after.write_bytes(b"after")
    form = operator.choose("key_press").identity
    enter(form, car_vin="WVW1", notes="Doors shut.")
    form.photos.show_paths((before,))
    operator.window.settings["key_press"].form.fields["angle_between_radials_rad"].edit.setText("90")
    operator.wait(operator.window.settings["key_press"].start.isEnabled)
    operator.click(operator.window.settings["key_press"].start)
    protocol = operator.finish()
    dialog = annotated(protocol, operator, "Doors shut.\nRain from line 3 on.", after)
    assert dialog.kept.text() == "With the test already: car.jpg." and dialog.keep.isEnabled()
    operator.click(dialog.keep)
    folder = operator.folder / "results" / operator.model.test.name
    # The record is written before the files of the report.
    operator.wait(lambda: "car_2.jpg" in (folder / "results.csv").read_text(encoding="utf-8"))
    operator.wait(protocol.annotate.isEnabled)
    _, _, progress = open_progress(operator.model.test.path, SCENARIOS)
    assert progress.identity.notes == "Doors shut.\nRain from line 3 on."
    assert [photo.name for photo in progress.identity.photos] == ["car.jpg", "car_2.jpg"]
    assert "notes and photos added" in progress.session
    assert (folder / "photos" / "car_2.jpg").read_bytes() == b"after"
    assert any("Rain from line 3 on." in cell for row in identity_table(protocol.protocol) for cell, *_ in row.cells)


def test_notes_that_cannot_be_kept_are_said_and_nothing_is_changed(operator, tmp_path):
    operator.begin()
    protocol = operator.finish()
    dialog = annotated(protocol, operator, "x" * 4001)
    assert "at most 4000 characters" in dialog.notes.note.text() and not dialog.keep.isEnabled()
    dialog.notes.show_text("Rain.")
    dialog.photos.show_paths((tmp_path / "gone.jpg",))
    assert not dialog.keep.isEnabled()
    dialog.photos.show_paths(())
    # Another application has taken the test up meanwhile.
    with Lock(operator.model.test.path):
        operator.click(dialog.keep)
        operator.wait(lambda: "Another application" in protocol.notice.text())
    assert open_progress(operator.model.test.path, SCENARIOS)[2].identity is None


def test_notes_are_kept_with_the_test_for_which_they_were_asked(operator):
    operator.begin()
    protocol = operator.finish()
    dialog = annotated(protocol, operator, "Rain.")
    first = operator.model.test
    # Without a window manager it takes the focus from what is held, and late.
    operator.wait(dialog.isActiveWindow)
    operator.window.activateWindow()
    operator.wait(operator.window.isActiveWindow)
    operator.click(protocol.done)
    operator.begin()
    operator.finish()
    second = operator.model.test
    operator.wait(protocol.annotate.isEnabled)
    operator.click(dialog.keep)
    operator.wait(lambda: first.name in protocol.notice.text().replace("\N{ZERO WIDTH SPACE}", ""))
    identities = [open_progress(test.path, SCENARIOS)[2].identity for test in (first, second)]
    assert identities == [Identity(notes="Rain."), None]
    assert "Rain." not in (operator.folder / "results" / second.name / "results.csv").read_text(encoding="utf-8")
