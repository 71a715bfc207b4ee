"""Notices about the robot's parts for the Operator."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from http.client import CannotSendRequest
from xml.parsers.expat import ExpatError
from xmlrpc.client import Fault, ProtocolError

import pytest
from dispatcher_link import Link

from mtr_core import names
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.disks.watch import DiskWatch
from mtr_dispatcher.master_watch import MasterWatch
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.emergency import EmergencyStop
from mtr_dispatcher.status.inputs import Inputs
from mtr_msgs.msg import CarEstimate, DriveStatus
from mtr_msgs.msg import Problem as ProblemMessage
from mtr_proto import robot_link_pb2 as link


@pytest.mark.parametrize("warns, state, told", [
    (True, EmergencyStop.ABSENT, True), (False, EmergencyStop.ABSENT, False), (True, EmergencyStop.RELEASED, False)])
def test_operator_reads_that_there_is_no_emergency_stop(warns, state, told):  # A4
    core = Dispatcher(Parameters(warn_without_emergency_stop=warns), Identity(7, "1.2.3", 0.25, 0.0))
    message = link.Status.FromString(core.status(Inputs(1.0, emergency_stop=state)))
    assert ("no_emergency_stop" in {notice.code for notice in message.notifications}) is told
    assert message.emergency_stop == state


def test_operator_reads_which_node_cannot_start_and_why_until_it_has():
    core = Dispatcher(Parameters(), Identity(7, "1.2.3", 0.25, 0.0))
    why = "Parameter speed_mps is 3 m/s; allowed is 0.05 to 2 m/s."
    told = link.Status.FromString(core.status(Inputs(1.0, start_failures={"walker": why})))
    notice = next(note for note in told.notifications if note.code == "node_cannot_start")
    assert notice.severity == link.SEVERITY_ERROR and "walker" in notice.text and why in notice.text
    later = link.Status.FromString(core.status(Inputs(2.0)))
    assert "node_cannot_start" not in {note.code for note in later.notifications}


def disk_watch(free_mb):
    """Return a watch of two folders whose disks have this free space; the disk of a missing folder cannot be read."""
    def usage(path):
        if str(path) not in free_mb:
            raise FileNotFoundError(path)
        return 10 ** 10, 0, int(1e6 * free_mb[str(path)])
    return DiskWatch([pathlib.Path("/ros"), pathlib.Path("/logs")], 200.0, 10.0, usage)


def test_operator_reads_that_a_disk_is_full_and_what_to_do_until_there_is_room():
    free_mb, told = {"/ros": 900.0, "/logs": 900.0}, []
    watch = disk_watch(free_mb)
    for free_mb["/logs"] in (900.0, 199.0, 240.0, 250.0):
        watch.update()
        told.append([(notice.severity, notice.text) for notice in Link().status(full_disk=watch.full).notifications
                     if notice.code == "disk_full"])
    full = (link.SEVERITY_ERROR, "The robot's disk is full (/logs); no test begins until 250 MB are free: "
                                 "delete old logs and bags.")
    assert told == [[], [full], [full], []]


def test_disk_that_tells_nothing_is_none_that_is_full():
    watch = disk_watch({})
    watch.update()
    assert watch.full is None
    half = disk_watch({"/logs": 10.0})
    half.update()
    assert half.full.folder == "/logs"


@pytest.mark.parametrize("code, is_told", [("drive_control.imu_frozen", True), ("drive_control.lidar_silent", True),
                                           ("drive_control.waiting_for_lidar", True),
                                           ("drive_control.waiting_for_odometry", True),
                                           ("drive_control.tilted", True), ("drive_control.tilted_too_far", True),
                                           ("drive_control.tilt_unknown", True),
                                           ("drive_control.obstacle", False), ("dispatcher.no_application", False)])
def test_operator_reads_which_sensor_stops_the_wheels(code, is_told):
    drive = DriveStatus(message="Why.", problems=[ProblemMessage(code=code, text="Why.")])
    notices = {notice.code: notice.text for notice in Link().status(drive=drive).notifications}
    assert notices.get("drive_control") == ("Why." if is_told else None)


@pytest.mark.parametrize("code", ["drive_control.lock_silent", "drive_control.waiting_for_lock"])
@pytest.mark.parametrize("owner, is_told", [("graph_watch", True), ("other", True), ("state_machine", False)])
def test_silent_owner_of_a_motion_lock_is_told_unless_it_is_missed_by_name(code, owner, is_told):
    silent = ProblemMessage(code=code, text="Silent.", names=["owner"], values=[owner])
    drive = DriveStatus(message="Silent.", problems=[silent])
    codes = {notice.code for notice in Link().status(drive=drive).notifications}
    assert ("drive_control" in codes) is is_told


@pytest.mark.parametrize("parameter", [None, [], "text", 7, {}])
def test_what_anybody_has_set_on_the_master_is_no_failure_of_a_node(parameter):
    master = MasterWatch(lambda _: parameter)
    master.update()
    assert master.failures == {} and master.preflight is None


@pytest.mark.parametrize("trouble", [ConnectionRefusedError("master"), CannotSendRequest(), Fault(1, "master"),
                                     ProtocolError("/", 500, "master", {}), ExpatError()])
def test_few_nodes_are_told_and_a_master_that_does_not_answer_changes_nothing(trouble):
    answers = [{f"node_{number}": "Why." for number in range(100)}, trouble]

    def ask(name):
        if name != names.START_FAILURES:
            return None
        answer = answers.pop(0)
        if isinstance(answer, Exception):
            raise answer
        return answer
    master = MasterWatch(ask)
    master.update()
    master.update()
    assert list(master.failures) == ["node_0", "node_1", "node_10", "node_11"]


@pytest.mark.parametrize("state, code, is_told", [
    (CarEstimate.LOCATED, "car_locator.sheet_contradicted", True), (CarEstimate.LOCATED, "car_locator.found", False),
    (CarEstimate.LOCATED, "", False), (CarEstimate.COLLECTING, "car_locator.sheet_contradicted", False),
    (CarEstimate.FAILED, "car_locator.sheet_contradicted", False)])
def test_data_sheet_that_the_car_contradicts_is_told_while_the_car_is_located(state, code, is_told):
    told = [ProblemMessage(code=code, text="Contradicted.")] if code else []
    car = CarEstimate(state=state, message="Contradicted.", problems=told)
    core = Dispatcher(Parameters(), Identity(7, "1.2.3", 0.25, 0.0))
    message = link.Status.FromString(core.status(Inputs(1.0, car=car)))
    notices = [(notice.severity, notice.text) for notice in message.notifications
               if notice.code == "sheet_contradicted"]
    assert notices == ([(link.SEVERITY_ERROR, "Contradicted.")] if is_told else [])
