"""Pictures: places on the screen, zoom, pan, ruler, the gliding robot."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import math

import pytest
from PyQt5.QtCore import QEvent, QPoint, QPointF, QRectF, Qt
from PyQt5.QtGui import QColor, QImage, QMouseEvent, QPainter
from PyQt5.QtTest import QTest
from PyQt5.QtWidgets import QApplication

from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.results.figure import Figure, Kind
from mtr_operator.domain.results.picture import PointRole, PointSet, Stretch
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.gui.pictures.glide import Glide
from mtr_operator.gui.pictures.layers.car_layer import CarLayer
from mtr_operator.gui.pictures.layers.layer import Canvas, paint_all
from mtr_operator.gui.pictures.layers.lines_layer import LinesLayer
from mtr_operator.gui.pictures.layers.points_layer import PointsLayer
from mtr_operator.gui.pictures.layers.robot_layer import TrailLayer
from mtr_operator.gui.pictures.layers.surroundings import step_for
from mtr_operator.gui.pictures.picture_panel import PicturePanel
from mtr_operator.gui.pictures.viewport import Viewport
from mtr_operator.gui.theme.appearance import Appearance
from mtr_operator.gui.theme.palette import LIGHT

VIEW = Viewport(400.0, 300.0, 50.0)


@pytest.fixture
def panel(qtbot):
    made = PicturePanel(Appearance())
    qtbot.addWidget(made)
    made.resize(500, 560)
    made.show()
    return made


def drag(view, pixel):
    """QTest.mouseMove moves the pointer of a screen, which there is none of."""
    event = QMouseEvent(QEvent.MouseMove, QPointF(pixel), Qt.NoButton, Qt.LeftButton, Qt.NoModifier)
    QApplication.sendEvent(view, event)


def painted(layer, px_per_m):
    """Picture of a layer alone."""
    image = QImage(400, 300, QImage.Format_RGB32)
    image.fill(QColor(LIGHT.surface))
    painter = QPainter(image)
    layer.paint(Canvas(painter, Viewport(400.0, 300.0, px_per_m), LIGHT))
    painter.end()
    return image


def is_blank(image, x, y, radius=2):
    return all(image.pixelColor(x + dx, y + dy).name() == LIGHT.surface
               for dx in range(-radius, radius + 1) for dy in range(-radius, radius + 1))


def test_trail_is_not_painted_across_a_gap__B4():
    trail = TrailLayer()
    trail.places = [(0.0, 3.0), (0.0, 2.0), None, (0.0, -2.0), (0.0, -3.0)]
    image = painted(trail, 50.0)
    assert is_blank(image, 200, 150)
    assert not is_blank(image, 75, 150) and not is_blank(image, 325, 150)


def test_body_from_which_distances_count_is_shown_within_an_outline_with_mirrors__B20():
    outline = ((2.25, 0.9), (0.5, 0.9), (0.5, 1.1), (0.3, 1.1), (0.3, 0.9), (-2.25, 0.9), (-2.25, -0.9), (2.25, -0.9))
    car = CarDimensions(4.5, 1.8, 0.01, 0.01, outline)
    across = int(200 - 0.9 * 60)
    seen = [not is_blank(painted(CarLayer(each, True), 60.0), across, 150 - dy, 0) for dy in range(20, 30)
            for each in (car,)]
    assert any(seen)


def test_dashes_of_many_lines_make_no_stripes_across_them__C():
    columns = range(60, 340, 14)
    lines = LinesLayer([Stretch((2.5, (200 - x) / 50.0), (-2.5, (200 - x) / 50.0), "") for x in columns])
    image = painted(lines, 50.0)
    inked = [sum(not is_blank(image, x, y, 0) for x in columns) for y in range(60, 240)]
    assert all(0 < count < len(columns) for count in inked)


def test_front_of_a_small_car_is_told_by_an_arrow():
    image = painted(CarLayer(CarDimensions(4.5, 1.8, 0.01, 0.01), True), 8.0)
    assert not is_blank(image, 200, 150 - 18 - 8, 0) and is_blank(image, 200, 150 + 18 + 8, 0)


def test_front_is_up_and_left_is_left():
    assert VIEW.to_screen((0.0, 0.0)) == (200.0, 150.0)
    assert VIEW.to_screen((1.0, 0.0)) == (200.0, 100.0)
    assert VIEW.to_screen((0.0, 1.0)) == (150.0, 150.0)


@pytest.mark.parametrize("pixel", [(0.0, 0.0), (123.0, 45.0), (400.0, 300.0)])
def test_place_and_pixel_are_inverse_after_zoom_and_pan(pixel):
    view = VIEW.panned(30.0, -20.0).zoomed(1.7, (10.0, 20.0))
    assert view.to_screen(view.to_car(pixel)) == pytest.approx(pixel)


def test_place_under_the_mouse_stays_when_zooming():
    place = VIEW.to_car((321.0, 99.0))
    assert VIEW.zoomed(3.0, (321.0, 99.0)).to_screen(place) == pytest.approx((321.0, 99.0))


def test_zoom_has_limits():
    assert VIEW.zoomed(1e9, (0.0, 0.0)).px_per_m == 800.0
    assert VIEW.zoomed(1e-9, (0.0, 0.0)).px_per_m == 4.0


def test_fit_shows_all_points():
    view = VIEW.fitted([(6.0, 0.0), (-2.0, 8.0)], 20.0)
    for point in ((6.0, 0.0), (-2.0, 8.0), (-6.0, -8.0)):
        x, y = view.to_screen(point)
        assert -1e-6 <= x - 20.0 <= 360.0 + 1e-6
        assert -1e-6 <= y - 20.0 <= 260.0 + 1e-6


def test_drag_pans(panel):
    view = panel.view
    before = view.viewport
    QTest.mousePress(view, Qt.LeftButton, pos=QPoint(100, 100))
    drag(view, QPoint(150, 130))
    QTest.mouseRelease(view, Qt.LeftButton, pos=QPoint(150, 130))
    assert view.viewport.to_screen((0.0, 0.0)) == pytest.approx(
        (before.to_screen((0.0, 0.0))[0] + 50.0, before.to_screen((0.0, 0.0))[1] + 30.0))


@pytest.mark.parametrize(("key", "attribute", "sign"), [
    (Qt.Key_Plus, "px_per_m", 1), (Qt.Key_Minus, "px_per_m", -1), (Qt.Key_Left, "middle_y", 1),
    (Qt.Key_Right, "middle_y", -1), (Qt.Key_Up, "middle_x", 1), (Qt.Key_Down, "middle_x", -1)])
def test_keyboard_zooms_and_pans(panel, key, attribute, sign):
    before = getattr(panel.view.viewport, attribute)
    QTest.keyClick(panel.view, key)
    assert (getattr(panel.view.viewport, attribute) - before) * sign > 0
    QTest.keyClick(panel.view, Qt.Key_0)
    assert getattr(panel.view.viewport, attribute) == pytest.approx(before)


def test_ruler_measures_between_two_places(panel):
    view = panel.view
    panel.ruler.setChecked(True)
    start, end = (QPoint(round(x), round(y)) for x, y in (view.viewport.to_screen(place)
                                                           for place in ((0.0, 0.0), (0.3, -0.4))))
    QTest.mousePress(view, Qt.LeftButton, pos=start)
    drag(view, end)
    assert view.ruler.length_m == pytest.approx(0.5, abs=0.02)
    assert panel.length.text().endswith(" m")
    panel.ruler.setChecked(False)
    assert view.ruler.length_m is None


def test_scale_has_a_round_length():
    assert step_for(50.0, 90.0) == 2.0
    assert step_for(200.0, 90.0) == 0.5


def test_robot_glides_from_one_status_to_the_next():
    glide = Glide()
    glide.put(Pose(0.0, 0.0, 3.1), 10.0)
    glide.put(Pose(0.1, 0.0, -3.1), 10.1)
    assert glide.at(10.1).x == pytest.approx(0.0)
    middle = glide.at(10.15)
    assert middle.x == pytest.approx(0.05)
    assert abs(middle.heading) == pytest.approx(math.pi, abs=0.01)
    assert glide.at(10.3).x == pytest.approx(0.1)
    assert glide.is_moving(10.15)
    assert not glide.is_moving(10.3)


def test_robot_jumps_after_a_gap_and_vanishes_when_lost():
    glide = Glide()
    glide.put(Pose(0.0, 0.0, 0.0), 10.0)
    glide.put(Pose(0.5, 0.0, 0.0), 12.0)
    assert glide.at(12.0).x == 0.5
    glide.put(None, 12.1)
    assert glide.at(12.1) is None


# Where the border lies on radials at these angles, clockwise from the front, in m and degrees.
PLACES = [(far_m * math.cos(math.radians(angle)), -far_m * math.sin(math.radians(angle)))
          for far_m, angle in ((2.1, 0.0), (2.0, 90.0), (1.9, 120.0), (1.9, 240.0))]


def labels_of(layers, px_per_m=50.0):
    """Boxes of all labels of a picture of 500x400 pixels."""
    image = QImage(500, 400, QImage.Format_RGB32)
    painter = QPainter(image)
    canvas = Canvas(painter, Viewport(500.0, 400.0, px_per_m), LIGHT)
    paint_all(layers, canvas)
    painter.end()
    return canvas.labels


def test_figures_hide_no_number_of_a_line_and_lie_inside_the_picture():
    lines = LinesLayer([Stretch((0.0, 0.0), place, "240\u00b0") for place in PLACES])
    figures = PointSet("press", PointRole.FIRST, tuple(PLACES), intervals=tuple((place, place) for place in PLACES),
                       figures=len(PLACES) * (Figure(Kind.VALUE, 5.58),))
    boxes = labels_of([lines, PointsLayer([figures], shows_figures=True)])
    assert len(boxes) == 2 * len(PLACES)
    assert not [box for box in boxes if not QRectF(0.0, 0.0, 500.0, 400.0).contains(box)]
    assert not [pair for pair in itertools.combinations(boxes, 2) if pair[0].intersects(pair[1])]
