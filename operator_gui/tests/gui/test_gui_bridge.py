"""The hop into the GUI thread: nothing is lost, nothing is flooded, and the window never waits for links."""
# SPDX-License-Identifier: Apache-2.0
import threading

import pytest
from PyQt5.QtWidgets import QApplication

from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.gui.bridge import FRAME_MS, HEARTBEAT_MS, Bridge
from mtr_operator.gui.pictures.layers.layer import Canvas, Layer
from mtr_operator.gui.pictures.layers.robot_layer import RobotLayer, WaypointLayer
from mtr_operator.gui.pictures.layers.surroundings import GridLayer
from mtr_operator.gui.pictures.picture_view import PictureView
from mtr_operator.gui.pictures.viewport import Viewport
from mtr_operator.gui.theme.appearance import Appearance
from mtr_operator.station.events import ActionBegun, RobotSnapshot
from mtr_operator.station.view_model import ViewModel

STATUSES = 5000


def snapshot(number):
    return RobotSnapshot(RobotStatus(id=number, robot_session_id=1, stamp_s=number / 10.0, x=1.0, y=2.0, heading=0.0,
                                 pose_valid=True), LockState.LOCKED, "")


def test_flood_of_statuses_is_one_batch_per_frame_and_the_newest_wins(qtbot):
    bridge, frames, threads = Bridge(ViewModel()), [], set()
    bridge.changed.connect(lambda: (frames.append(bridge.model.robot.status.id), threads.add(threading.get_ident())))

    def flood():
        for number in range(1, STATUSES + 1):
            bridge.mailbox.put_robot(snapshot(number))
    thread = threading.Thread(target=flood)
    thread.start()
    thread.join()
    qtbot.waitUntil(lambda: bool(frames) and frames[-1] == STATUSES)
    assert len(frames) == 1
    assert threads == {threading.get_ident()}


def test_status_after_a_pause_is_shown_at_once_and_one_that_follows_waits_for_its_frame(qtbot):
    bridge = Bridge(ViewModel())
    bridge.mailbox.put_robot(snapshot(1))
    assert bridge._frame.isActive() and bridge._frame.interval() == 0
    qtbot.waitUntil(lambda: bridge.frames == 1)
    bridge.mailbox.put_robot(snapshot(2))
    assert 0 < bridge._frame.interval() <= FRAME_MS
    qtbot.waitUntil(lambda: bridge.frames == 2)
    assert bridge.model.robot.status.id == 2


def test_heartbeat_beside_a_robot_that_is_heard_puts_no_status_off(qtbot):
    """It came every 500 ms, and the Status after it waited for the next frame."""
    bridge = Bridge(ViewModel())
    bridge.start()
    qtbot.waitUntil(lambda: bridge._heartbeat.remainingTime() < HEARTBEAT_MS - 50)
    bridge.mailbox.put_robot(snapshot(1))
    qtbot.waitUntil(lambda: bridge.frames == 1)
    assert bridge._heartbeat.remainingTime() > HEARTBEAT_MS - 50
    qtbot.waitUntil(lambda: bridge.frames == 2)
    assert bridge.model.robot.status.id == 1


def test_events_keep_their_order_and_none_is_lost(qtbot):
    bridge, notice = Bridge(ViewModel()), []
    bridge.happened.connect(lambda event: notice.append(event.text))

    def talk():
        for number in range(200):
            bridge.mailbox.put(ActionBegun(str(number)))
            bridge.mailbox.put_robot(snapshot(number))
    thread = threading.Thread(target=talk)
    thread.start()
    qtbot.waitUntil(lambda: len(notice) == 200)
    thread.join()
    assert notice == [str(number) for number in range(200)]
    assert bridge.frames <= 200


def test_frames_are_thirty_a_second():
    assert round(1000 / FRAME_MS) == 30


class Counting(Layer):
    """Counts how often it is painted."""

    def __init__(self, is_moving):
        self.is_moving, self.count = is_moving, 0

    def paint(self, canvas):
        self.count += 1


def test_what_stands_still_is_painted_once(qtbot):
    view, still, moving = PictureView(Appearance()), Counting(False), Counting(True)
    qtbot.addWidget(view)
    view.show()
    view.show_layers([still, moving])
    for _ in range(30):
        view.grab()
    assert (still.count, moving.count) == (1, 30)
    view.refresh()
    view.grab()
    assert still.count == 2


def test_brief_layer_is_painted_when_it_changes_and_not_with_each_frame(qtbot):
    view, still, brief, moving = PictureView(Appearance()), Counting(False), Counting(False), Counting(True)
    brief.is_brief = True
    qtbot.addWidget(view)
    view.show()
    view.show_layers([still, brief, moving])
    for _ in range(10):
        view.grab()
    assert (still.count, brief.count, moving.count) == (1, 1, 10)
    view.refresh_brief()
    view.grab()
    assert (still.count, brief.count) == (1, 2)
    view.add_news(still)
    view.grab()
    assert brief.count == 3


class Yard(GridLayer):
    """Sixteen metres of it are shown."""

    def points(self):
        return (-8.0, -8.0), (8.0, 8.0)


class SeenView(PictureView):
    """Keeps the regions that were painted."""

    def __init__(self):
        super().__init__(Appearance())
        self.regions = []

    def paintEvent(self, event):
        self.regions.append(event.region().boundingRect())
        super().paintEvent(event)


@pytest.mark.parametrize("way", [(0.02, 0.0, 0.1), (1.5, -1.0, 2.0)])
def test_robot_that_moves_leaves_no_trace_and_costs_only_its_surroundings(qtbot, way):
    view, robot = SeenView(), RobotLayer()
    qtbot.addWidget(view)
    view.resize(600, 600)
    robot.key, robot.sigma_m, robot.pose = (0.26, 0.0), 0.02, Pose(3.0, 1.0, 0.5)
    view.show_layers([Yard(), robot])
    view.show()
    qtbot.waitExposed(view)
    qtbot.waitUntil(lambda: bool(view.regions))
    QApplication.processEvents()
    view.regions.clear()
    for step in range(3):
        robot.pose = Pose(3.0 + way[0] * step, 1.0 + way[1] * step, 0.5 + way[2] * step)
        view.move_layer(robot)
        qtbot.waitUntil(lambda step=step: len(view.regions) > step)
    assert all(region.width() * region.height() < 0.6 * 600 * 600 for region in view.regions)
    shown = view.screen().grabWindow(view.winId()).toImage()
    view.update()
    qtbot.waitUntil(lambda: len(view.regions) == 4)
    assert shown == view.screen().grabWindow(view.winId()).toImage()
    assert not shown.isNull()


def test_hundreds_of_points_lie_where_each_of_them_does():
    canvas = Canvas(None, Viewport(400.0, 300.0).panned(7.0, -3.0), None)
    points = [(0.1 * number, 3.0 - 0.2 * number) for number in range(40)]
    assert [canvas.many(points)[index] for index in range(40)] == [canvas.at(point) for point in points]
    assert len(canvas.many(())) == 0


def test_waypoint_and_robot_that_stand_still_cost_only_the_surroundings_of_the_robot(operator, monkeypatch):
    """With each Status the whole picture was painted, and the waypoint with each frame."""
    screen, paints = operator.begin(), []
    view = screen.panel.view
    operator.wait(lambda: screen.picture.waypoint.pose is not None and screen.picture.robot.pose is not None)
    monkeypatch.setattr(WaypointLayer, "paint", lambda layer, canvas: paints.append(layer))
    # On a busy machine the test may be over, and the screen hidden, by now.
    screen.picture.show_model(0.0)
    view.grab()
    paints.clear()
    asked = []
    monkeypatch.setattr(view, "update", lambda *region: asked.append(region))
    for _ in range(3):
        screen.picture.show_model(screen.picture._glide._to_s)
    assert len(asked) == 3 and all(region and region[0] != view.rect() for region in asked)
    view.grab()
    assert not paints
    operator.model.trail.append((2.0, 2.0))
    screen.picture.show_model(0.0)
    assert () in asked


def test_full_can_bus_is_read_outside_the_gui_thread(operator, monkeypatch):
    """At 500 kbit/s some 4000 frames come per second; not one of them may cost the window anything."""
    threads = set()
    car_type = type(operator.application.flow.connecting.worker._links.car)
    observe = car_type.observe

    def seen(self, status):
        threads.add(threading.current_thread().name)
        return observe(self, status)
    monkeypatch.setattr(car_type, "observe", seen)
    operator.wait(lambda: threads)
    operator.begin()
    operator.finish()
    assert threads == {"links"}


def test_measurement_repaints_the_still_part_only_for_results(operator):
    screen = operator.begin()
    operator.finish()
    # Once when shown, once for the mapped Car and the plan, once per line, and for layout changes of the legend.
    assert screen.panel.view.still_paints <= 4 + 3 * len(operator.model.results)
