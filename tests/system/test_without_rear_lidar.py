"""A robot without a rear LiDAR maps the Car and drives to waypoints without help, on ground that it has seen."""
# SPDX-License-Identifier: Apache-2.0
from mtr_benchmarks.faults.robot import FaultyRobot
from mtr_benchmarks.faults.robots import RobotKind
from mtr_benchmarks.harness.own_process import in_own_process
from mtr_proto import robot_link_pb2 as link

LEGS = 2


def drive(folder):
    """Results of the legs after a map, and the texts of all holds."""
    with FaultyRobot(folder, RobotKind({"rear_lidar": "false"})) as robot:
        robot.wait_until(lambda: robot.status.mode == link.MODE_READY_TO_MAP_CAR, "readiness")
        robot.map_car()
        robot.wait_until(lambda: robot.knows_car or robot.status.hold_id, "a map of the Car")
        results = []
        while len(results) < LEGS and not robot.status.hold_id:
            robot.drive()
            robot.wait_until(lambda: robot.has_arrived or robot.status.hold_id, "the end of the leg")
            results.append(robot.status.waypoint_result)
        return results, [note.text for note in robot.status.notifications if robot.status.hold_id]


def test_it_needs_nobody_who_drives_it_by_hand(out):
    results, holds = in_own_process(drive, out)
    assert holds == []
    assert results == LEGS * [link.WAYPOINT_RESULT_REACHED]
