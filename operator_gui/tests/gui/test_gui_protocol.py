"""The protocol screen: table and picture belong together, and files hold what the screen shows."""
# SPDX-License-Identifier: Apache-2.0
import csv

import pytest
from PyQt5.QtCore import QByteArray
from PyQt5.QtGui import QImage
from PyQt5.QtSvg import QSvgRenderer

from mtr_operator.domain.results.line_result import LineStatus, MeasuredDistance
from mtr_operator.gui.pictures.export import png
from mtr_operator.gui.pictures.layers.points_layer import PointsLayer
from mtr_operator.gui.pictures.protocol_sheet import ProtocolSheet
from mtr_operator.gui.screens.results_model import interval_text
from mtr_operator.gui.theme.palette import LIGHT


@pytest.fixture
def protocol(operator, opener):
    opener.passive = True
    operator.begin("autolock")
    return operator.finish()


def points_layer(protocol):
    return next(layer for layer in protocol.panel.view.layers if isinstance(layer, PointsLayer))


def test_table_holds_place_distance_and_uncertainty(protocol):
    model = protocol.table.model()
    assert [model.headerData(column, 1) for column in range(model.columnCount())] == \
        ["#", "Axis", "Unlock [cm]", "\N{PLUS-MINUS SIGN}", "Lock [cm]", "\N{PLUS-MINUS SIGN}"]
    first = [model.data(model.index(0, column)) for column in range(model.columnCount())]
    assert first[:2] == ["1", "front"]
    assert float(first[2]) == pytest.approx(150.0, abs=15.0)
    assert float(first[4]) == pytest.approx(220.0, abs=15.0)
    assert float(first[3]) > 0.0


def test_row_marks_its_points_and_point_selects_its_row(protocol, operator):
    protocol.table.selectRow(2)
    marked = points_layer(protocol).chosen
    assert len(marked) == 2
    other = protocol.protocol.picture_of(5).point_sets[0].known[0]
    protocol.panel.view.clicked.emit(*other)
    assert protocol.table.currentIndex().row() == 5
    protocol.panel.view.clicked.emit(other[0] + 30.0, other[1])
    assert protocol.table.currentIndex().row() == 5


def test_areas_are_closed_outlines(protocol):
    unlocked, locked = (points for points in protocol.protocol.picture.point_sets if points.is_outline)
    assert len(unlocked.known) == len(locked.known) == 8
    assert all(is_known for _, _, is_known in [*unlocked.pieces(), *locked.pieces()])


def test_save_writes_csv_and_png(protocol, operator):
    operator.click(protocol.save)
    operator.wait(lambda: "Saved" in protocol.notice.text())
    folder = operator.folder / "results" / operator.model.test.name
    rows = list(csv.DictReader(line for line in (folder / "results.csv").read_text(encoding="utf-8").splitlines()
                               if not line.startswith("#")))
    assert len(rows) == 8
    assert QImage(str(folder / "protocol.png")).width() == 2376
    assert "results.csv" in protocol.notice.text()


def test_save_pdf_and_svg(protocol, operator):
    for button, name in ((protocol.save_pdf, "protocol.pdf"), (protocol.save_svg, "protocol.svg")):
        operator.click(button)
        operator.wait(lambda name=name: name in protocol.notice.text() and protocol.save.isEnabled())
    folder = operator.folder / "results" / operator.model.test.name
    assert (folder / "protocol.pdf").read_bytes().startswith(b"%PDF-")
    assert QSvgRenderer(QByteArray((folder / "protocol.svg").read_bytes())).isValid()


def test_vanished_result_folder_is_asked_for_again(protocol, operator, monkeypatch):
    other = operator.folder / "other"
    monkeypatch.setattr("mtr_operator.gui.screens.protocol.ask_folder", lambda *_: other)
    (operator.folder / "results").write_text("a file where the folder was", encoding="utf-8")
    operator.click(protocol.save)
    operator.wait(lambda: "Saved" in protocol.notice.text())
    assert (other / operator.model.test.name / "results.csv").exists()
    assert operator.application.flow.store.settings.result_folder == other


def test_reliable_range_of_each_angle_is_written_in_the_picture(operator):
    operator.begin("key_press")
    protocol = operator.finish()
    layer = points_layer(protocol)
    assert layer.shows_distances
    assert len(layer.sets[0].known) == 4


def test_new_test_leads_to_the_beginning(protocol, operator):
    operator.click(protocol.done)
    assert operator.window.screen is operator.window.welcome
    assert operator.model.test is None


def test_sheet_is_painted_by_the_layers_of_the_screen(protocol):
    on_screen = [type(layer) for layer in protocol.panel.view.layers]
    in_file = [type(layer) for layer in ProtocolSheet(protocol.protocol).picture.layers]
    assert in_file == on_screen


def test_sheet_shows_what_was_measured(protocol):
    image = QImage.fromData(png(ProtocolSheet(protocol.protocol)))
    colours = {image.pixelColor(x, y).name() for x in range(0, image.width(), 3) for y in range(0, image.height(), 3)}
    assert {LIGHT.first, LIGHT.second, LIGHT.body, LIGHT.surface} <= colours


@pytest.mark.parametrize(("low_m", "high_m", "text"), [
    (5.12, 5.71, "512\N{EN DASH}571"), (5.12, None, "> 512"), (None, 5.71, "< 571"), (None, None, "")])
def test_interval_of_a_distance_is_told_also_when_it_is_open(low_m, high_m, text):
    assert interval_text(MeasuredDistance("press", LineStatus.OK, 5.4, 0.1, low_m, high_m)) == text


def test_table_of_a_search_has_a_column_of_intervals(operator):
    operator.begin("key_press")
    model = operator.finish().table.model()
    assert [model.headerData(column, 1) for column in range(2, model.columnCount())] == [
        "Press [cm]", "\N{PLUS-MINUS SIGN}", "95 %"]
    low, high = model.data(model.index(0, 4)).split("\N{EN DASH}")
    assert float(low) < float(model.data(model.index(0, 2))) < float(high)
