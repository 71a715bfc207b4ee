"""The protocol screen: table and picture belong together, and files hold what the screen shows."""
# SPDX-License-Identifier: Apache-2.0
import csv
import pathlib
import shutil
import threading

import pytest
from PyQt5.QtCore import QAbstractItemModel, QByteArray, QCoreApplication, QEvent, QItemSelectionModel, Qt
from PyQt5.QtGui import QImage
from PyQt5.QtSvg import QSvgRenderer
from PyQt5.QtWidgets import QApplication

from mtr_operator.domain.results.line_result import LineStatus, MeasuredDistance
from mtr_operator.gui.figure_text import interval_text, sign_text
from mtr_operator.gui.pictures.export import pdf, png
from mtr_operator.gui.pictures.layers.points_layer import PointsLayer
from mtr_operator.gui.pictures.protocol_sheet import ProtocolSheet
from mtr_operator.gui.pictures.protocol_tables import Row, pages_of, table_rows
from mtr_operator.gui.screens.measurement_facts import newest_text
from mtr_operator.gui.theme.palette import LIGHT


def points_layer(protocol):
    return next(layer for layer in protocol.panel.view.layers if isinstance(layer, PointsLayer))


def test_table_holds_place_distance_and_uncertainty__A7(protocol):
    model = protocol.table.model()
    assert [model.headerData(column, 1) for column in range(model.columnCount())] == \
        ["#", "Axis", "Unlock [m]", "key \N{PLUS-MINUS SIGN} [m]", "Lock [m]", "key \N{PLUS-MINUS SIGN} [m]"]
    assert "at this one event" in model.headerData(3, Qt.Horizontal, Qt.ToolTipRole)
    first = [model.data(model.index(0, column)) for column in range(model.columnCount())]
    assert first[:2] == ["1", "front"]
    assert float(first[2]) == pytest.approx(1.5, abs=0.15)
    assert float(first[4]) == pytest.approx(2.2, abs=0.15)
    assert float(first[3]) > 0.0


def test_row_marks_its_points_and_point_selects_its_row(protocol, operator):
    protocol.table.selectRow(2)
    marked = points_layer(protocol).chosen
    assert len(marked) == 2
    others = points_layer(protocol).sets[0]
    other = others.known[5]
    protocol.panel.view.clicked.emit(*other)
    assert protocol.table.currentIndex().row() == 5
    protocol.panel.view.clicked.emit(other[0] + 30.0, other[1])
    assert protocol.table.currentIndex().row() == 5


def test_window_goes_on_while_the_picture_of_a_protocol_is_computed(operator, monkeypatch):
    operator.begin("key_press")
    may_end, scenario = threading.Event(), operator.model.test.scenario
    picture = scenario.picture

    def late(*arguments):
        assert may_end.wait(30.0), "the window waits for the picture"
        return picture(*arguments)

    operator.wait(lambda: operator.model.line == operator.model.total)
    monkeypatch.setattr(type(scenario), "picture", staticmethod(late))
    operator.wait(lambda: operator.window.screen is operator.window.protocol)
    screen = operator.window.protocol
    screen.table.selectRow(1)
    assert not screen.is_pictured and not points_layer(screen).points()
    may_end.set()
    operator.wait(lambda: screen.is_pictured)
    assert points_layer(screen).chosen
    saved(screen, operator)


def test_picture_that_cannot_be_computed_is_said(protocol, operator, monkeypatch):
    saved(protocol, operator)
    said = []
    monkeypatch.setattr(type(protocol.protocol), "computed", lambda _: 1 // 0)
    monkeypatch.setattr(protocol, "_show_notice", said.append)
    protocol.show_test()
    operator.wait(lambda: "ZeroDivisionError" in said[-1] and protocol.save.isEnabled())
    assert not protocol.is_pictured and protocol.table.model().rowCount() == 8


def test_row_of_an_invalid_line_says_below_why(operator, opener):
    screen = operator.begin("key_press")
    operator.wait(lambda: operator.model.line == 2 and screen.skip.isEnabled())
    operator.click(screen.skip)
    protocol = operator.finish()
    saved(protocol, operator)
    protocol.table.selectRow(1)
    assert "The line was skipped by the Operator." in protocol.notice.text()
    protocol.table.selectRow(0)
    assert "Saved" in protocol.notice.text() and "skipped" not in protocol.notice.text()


def test_protocol_of_the_test_before_is_kept_no_longer_than_it_is_shown(protocol, operator):
    def models():
        # With a model goes what was chosen in it, at the next turn.
        for _ in range(2):
            QCoreApplication.sendPostedEvents(None, QEvent.DeferredDelete)
        return len(protocol.findChildren(QAbstractItemModel)), len(protocol.findChildren(QItemSelectionModel))

    saved(protocol, operator)
    protocol.table.selectRow(2)
    before, shown = models(), protocol.protocol
    for row in range(3):
        protocol.show_test()
        protocol.table.selectRow(row)
        # Two that write into one folder would be in each other's way.
        saved(protocol, operator)
    assert models() == before
    assert protocol.table.currentIndex().row() == 2
    assert protocol.protocol is not shown


def test_areas_are_closed_outlines(protocol):
    unlocked, locked = (points for points in protocol.protocol.picture.point_sets if points.is_outline)
    assert len(unlocked.known) == len(locked.known) == 8
    assert all(is_known for _, _, is_known in [*unlocked.pieces(), *locked.pieces()])


def saved(protocol, operator):
    """Wait until the files are written."""
    operator.wait(lambda: "Saved" in protocol.notice.text() and protocol.save.isEnabled())


def test_end_of_a_test_writes_csv_and_png_by_itself__B7(protocol, operator):
    saved(protocol, operator)
    folder = operator.folder / "results" / operator.model.test.name
    assert {path.name for path in folder.iterdir()} == {"budget.json", "progress.json", "protocol.png", "results.csv"}
    assert protocol.notice.text().startswith("8 lines. Saved protocol.png, results.csv to ")


def test_test_from_a_file_is_not_written_before_it_is_asked_for__B7(protocol, operator):
    saved(protocol, operator)
    path = operator.model.test.path
    folder = operator.folder / "results" / operator.model.test.name
    operator.click(protocol.done)
    shutil.rmtree(folder)
    operator.application.flow.open(path)
    assert protocol.notice.text() == "8 lines. Not saved as CSV and PNG yet."
    assert protocol.save.isEnabled() and not folder.exists()


def test_save_writes_csv_and_png(protocol, operator):
    saved(protocol, operator)
    shutil.rmtree(operator.folder / "results" / operator.model.test.name)
    operator.click(protocol.save)
    saved(protocol, operator)
    folder = operator.folder / "results" / operator.model.test.name
    rows = list(csv.DictReader(line for line in (folder / "results.csv").read_text(encoding="utf-8").splitlines()
                               if not line.startswith("#")))
    assert len(rows) == 8
    image = QImage(str(folder / "protocol.png"))
    assert (image.width(), image.height()) == (2376, 1680 * ProtocolSheet(protocol.protocol).pages)
    assert "results.csv" in protocol.notice.text()


def test_save_pdf_and_svg(protocol, operator):
    saved(protocol, operator)
    for button, name in ((protocol.save_pdf, "protocol.pdf"), (protocol.save_svg, "protocol.svg")):
        operator.click(button)
        operator.wait(lambda name=name: name in protocol.notice.text() and protocol.save.isEnabled())
    folder = operator.folder / "results" / operator.model.test.name
    assert (folder / "protocol.pdf").read_bytes().startswith(b"%PDF-")
    assert QSvgRenderer(QByteArray((folder / "protocol.svg").read_bytes())).isValid()


def test_vanished_result_folder_is_asked_for_again(operator, opener, monkeypatch):
    other = operator.folder / "other"
    monkeypatch.setattr("mtr_operator.gui.screens.protocol_files.ask_folder", lambda *_: other)
    (operator.folder / "results").write_text("a file where the folder was", encoding="utf-8")
    opener.passive = True
    operator.begin("autolock")
    protocol = operator.finish()
    saved(protocol, operator)
    assert (other / operator.model.test.name / "results.csv").exists()
    assert operator.application.flow.store.settings.result_folder == other


def test_reliable_range_of_each_angle_is_written_in_the_picture(operator):
    operator.begin("key_press")
    protocol = operator.finish()
    layer = points_layer(protocol)
    assert layer.shows_figures
    assert len(layer.sets[0].known) == len([figure for figure in layer.sets[0].figures if figure]) == 4


def test_scan_is_told_as_what_it_knows_in_table_picture_and_last_result__A5_A6(operator):
    screen = operator.choose("key_press")
    screen.form.choices["method"].box.setCurrentIndex(screen.form.choices["method"].box.findData("scan"))
    screen.form.fields["angle_between_radials_rad"].edit.setText("180")
    screen.form.fields["maximum_distance_m"].edit.setText("5")
    operator.wait(screen.start.isEnabled)
    operator.click(screen.start)
    protocol = operator.finish()
    model = protocol.table.model()
    assert [model.data(model.index(row, 2)) for row in range(2)] == ["at least 4.50", "at least 4.50"]
    assert newest_text(operator.model) == "2 (180\N{DEGREE SIGN}): press at least 4.50 m"
    beyond = next(points for points in points_layer(protocol).sets if points.label == "Border farther than here")
    assert len(beyond.known) == 2 and {sign_text(figure) for figure in beyond.figures} == {
        "\N{GREATER-THAN OR EQUAL TO} 4.50 m"}


def test_chosen_lines_are_measured_again_and_the_rest_stays__B7(protocol, operator):
    saved(protocol, operator)
    assert not protocol.again.isEnabled()
    before = [result.unlock_robot_time_s for result in operator.model.results]
    selection = protocol.table.selectionModel()
    for row in (1, 4):
        selection.select(protocol.table.model().index(row, 0), selection.Select | selection.Rows)
    operator.wait(protocol.again.isEnabled)
    operator.click(protocol.again)
    assert operator.window.screen is operator.window.measurement
    operator.wait(lambda: operator.model.total and operator.model.done == 6)
    operator.finish()
    after = [result.unlock_robot_time_s for result in operator.model.results]
    assert [then != now for then, now in zip(before, after)] == [index in (1, 4) for index in range(8)]
    assert operator.model.test.progress.session["measured again"] == "2, 5"
    assert operator.model.test.again == ()
    saved(protocol, operator)
    lines = (operator.folder / "results" / operator.model.test.name / "results.csv").read_text(encoding="utf-8")
    assert "# measured again: 2, 5" in lines


def test_lines_are_not_measured_again_while_something_stands_against_it(protocol, operator, opener):
    protocol.table.selectRow(0)
    operator.wait(protocol.again.isEnabled)
    opener.spoil_with(battery_percent=5)
    operator.wait(lambda: not protocol.again.isEnabled())


def test_sheet_holds_every_distance_and_what_they_are_per_side__A9(protocol):
    rows = [" ".join(text for text, _, _ in row.cells) for row in table_rows(protocol.protocol)]
    results = operator_results(protocol)
    assert rows[0].split() == ["Unlock", "Lines", "Minimum", "[m]", "Mean", "[m]", "Maximum", "[m]", "Worst", "line"]
    assert any(row.startswith("all sides 8 ") for row in rows)
    for result in results:
        text = next(row for row in rows if row.startswith(f"{result.number} {result.place} "))
        assert f" {result.unlock_distance_m:.3f} " in text and f" {result.lock_distance_m:.3f} " in text
    assert any("at this one event" in row for row in rows)
    assert any(row.startswith("started: ") for row in rows) and any(row.startswith("Car frame 1: ") for row in rows)


def operator_results(protocol):
    return protocol.protocol.progress.results


def test_pages_of_a_long_protocol_stand_one_below_the_other__A9(protocol, monkeypatch):
    monkeypatch.setattr("mtr_operator.gui.pictures.protocol_sheet._ROWS", 6)
    sheet = ProtocolSheet(protocol.protocol)
    assert sheet.pages > 4
    image = QImage.fromData(png(sheet))
    assert (image.width(), image.height()) == (1188, 840 * sheet.pages)
    assert pdf(sheet).count(b"/Type /Page\n") == sheet.pages


def test_no_page_ends_with_a_heading_or_begins_with_nothing__A9():
    head, line, gap = Row((("Head", 1.0, False),), True), Row((("1", 1.0, False),)), Row(())
    assert pages_of([line, line, head, line], 3) == [[line, line], [head, line]]
    assert pages_of([line, line, gap, head, line], 2) == [[line, line], [head, line]]
    assert pages_of([], 3) == [[]]


def test_new_test_leads_to_the_beginning(protocol, operator):
    operator.click(protocol.done)
    assert operator.window.screen is operator.window.welcome
    assert operator.model.test is None


@pytest.mark.parametrize("size", [(1024, 700), (1366, 768)])
def test_sentence_that_comes_moves_no_button_under_the_mouse(protocol, operator, size):
    operator.window.resize(*size)
    QApplication.processEvents()
    buttons = [protocol.save, protocol.save_pdf, protocol.bundle, protocol.done]
    places = [each.mapTo(operator.window, each.rect().center()) for each in buttons]
    files = protocol._files
    files._folder = pathlib.Path("/home/operator/measurements/2026-11-23/a car with a long name/autolock of the day")
    files._said = "It is bundle 12 of laboratory 3."
    files._learn_written([files._folder / name for name in ("results.csv", "protocol.png", "autolock.mtr.zip")])
    QApplication.processEvents()
    assert [each.mapTo(operator.window, each.rect().center()) for each in buttons] == places


def test_sheet_is_painted_by_the_layers_of_the_screen(protocol):
    on_screen = [type(layer) for layer in protocol.panel.view.layers]
    in_file = [type(layer) for layer in ProtocolSheet(protocol.protocol).picture.layers]
    assert in_file == on_screen


def test_sheet_shows_what_was_measured(protocol):
    image = QImage.fromData(png(ProtocolSheet(protocol.protocol)))
    colours = {image.pixelColor(x, y).name() for x in range(0, image.width(), 3) for y in range(0, image.height(), 3)}
    assert {LIGHT.first, LIGHT.second, LIGHT.body, LIGHT.surface} <= colours


@pytest.mark.parametrize(("low_m", "high_m", "text"), [
    (5.12, 5.71, "5.12 to 5.71"), (5.12, None, "at least 5.12"), (None, 5.71, "at most 5.71"), (None, None, "")])
def test_interval_of_a_distance_is_told_also_when_it_is_open(low_m, high_m, text):
    assert interval_text(MeasuredDistance("press", LineStatus.OK, 5.4, 0.1, low_m, high_m)) == text


def test_table_of_a_search_has_a_column_of_intervals(operator):
    operator.begin("key_press")
    model = operator.finish().table.model()
    assert [model.headerData(column, 1) for column in range(2, model.columnCount())] == [
        "Press [m]", "\N{PLUS-MINUS SIGN} [m]", "95 % [m]"]
    low, high = model.data(model.index(0, 4)).split(" to ")
    assert float(low) < float(model.data(model.index(0, 2))) < float(high)
