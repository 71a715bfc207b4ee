"""What the robot sees, in the pictures."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from fit_checks import CAR, tell
from PyQt5.QtGui import QColor

from mtr_operator.domain.surroundings import StopZone, Surroundings
from mtr_operator.gui.flow import Step
from mtr_operator.gui.header.check_texts import check_advice, check_text
from mtr_operator.station.checks.checklist import hindrances
from mtr_operator.station.checks.finding import Check, Finding, State
from mtr_operator.station.sight.view import View

WALL = tuple((3.0, -2.0 + 0.05 * index) for index in range(81))


def colours(view):
    """Colours in the picture."""
    image = view.grab().toImage()
    return {image.pixelColor(x, y).name() for x in range(0, image.width()) for y in range(0, image.height())}


def test_measurement_shows_returns_path_and_obstacle(operator, opener):
    screen = operator.begin("autolock")
    layer = screen.picture.sight
    opener.spoil_with(pose_valid=True, x=5.0, y=0.0, heading=0.0, surroundings=Surroundings(
        WALL, ((5.0, 0.0), (5.0, 3.0)), StopZone.BLOCKED, (0.7, 0.0)))
    operator.wait(lambda: layer.view is not None and len(layer.view.points) == len(WALL))
    assert layer.view.obstacle[1] == 0.7
    opener.is_silent = True
    operator.wait(lambda: layer.view is None)


@pytest.mark.parametrize(("zone", "colour"), [(StopZone.BLOCKED, "danger"), (StopZone.SLOWED, "warning")])
def test_obstacle_is_ringed_in_the_colour_of_what_it_does(operator, zone, colour):
    screen = operator.begin("autolock")
    operator.application.flow.stop()
    screen.picture.sight.view = View(np.empty((0, 2)), (), (4.0, 0.0), zone, ((3.0, 0.0), 0.7))
    screen.panel.view.refresh_brief()
    palette = operator.application.appearance.palette
    seen = colours(screen.panel.view)
    assert QColor(getattr(palette, colour)).name() in seen


def test_preview_says_which_lines_end_in_a_wall__8(application, main):
    tell(application)
    main.types.chosen.emit("key_press")
    screen = main.settings["key_press"]
    assert "Something stands" not in screen.caution.text()
    obstacles = application.flow.model.obstacles
    obstacles.places, obstacles.version = np.array([[5.15, 0.1], [5.15, -0.1]]), 1
    main._show_model()
    assert np.array_equal(screen._obstacles.places, obstacles.places)
    # The Car itself is seen, too: it has its own outline, and is nothing that stands around it.
    obstacles.places, obstacles.version = np.array([[5.15, 0.1], [5.15, -0.1], [2.2, 0.0], [0.0, -1.1]]), 2
    main._show_model()
    assert np.array_equal(screen._obstacles.places, obstacles.places[:2])
    word = {"en": "in the way of radial 1: grey squares, the nearest 2.9 m from the Car.",
            "cs": "V cest"}[application.language.code]
    assert word in screen.caution.text()
    sentence = {"en": "Something stands in the way of lines 1, the nearest 2.9 m from the Car. Move it",
                "cs": "V cest\u011b p\u0159\u00edmek 1"}[application.language.code]
    item = way_of(application)
    assert (item.state, item.said) == (State.NOTE, "1")
    assert sentence in f"{check_text(item)} {check_advice(item)}"
    # A caution: the robot's planner decides.
    assert item not in hindrances(application.flow.model.checklist)


def test_preview_says_where_the_robot_has_not_looked_and_the_checklist_when_all_is_free__8(application, main):
    tell(application)
    main.types.chosen.emit("key_press")
    screen, model = main.settings["key_press"], application.flow.model
    assert "seen" not in screen.notice.text()
    model.obstacles.seen[:, 200:] = True
    main._show_model()
    assert "Not all seen by the robot yet: radial " in screen.notice.text() or application.language.code == "cs"
    assert way_of(application).finding is Finding.WAY_UNSEEN and way_of(application).state is State.UNKNOWN
    model.obstacles.seen[:] = True
    main._show_model()
    assert way_of(application).finding is Finding.WAY_FREE and way_of(application).state is State.GOOD
    main._show_step(Step.WELCOME)
    assert way_of(application).finding is Finding.WAY_TO_COME


def way_of(application):
    # However long the pictures before took, the robot has just been heard.
    tell(application)
    [item] = [item for item in application.flow.model.checklist if item.check is Check.WAY]
    return item


def test_map_of_the_obstacles_follows_the_robot(operator, opener):
    opener.spoil_with(pose_valid=True, x=5.0, y=0.0, heading=0.0, car=CAR,
                      surroundings=Surroundings(WALL))
    operator.wait(lambda: len(operator.model.obstacles.places) > 10)

