"""Service mode at the robot: the ROS service that orders it, the command that calls it, and where it is remembered."""
# SPDX-License-Identifier: Apache-2.0
import argparse
import pathlib
import sys
from typing import List, Optional, Tuple

import rospkg
import rospy

from mtr_core import names
from mtr_core.liveness import NS
from mtr_core.lockstep import clock
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_msgs.srv import OrderServiceMode, OrderServiceModeRequest, OrderServiceModeResponse

from .. import problems
from ..parameters import Parameters
from .file import FOLDER_NAME, ServiceFile, recalled
from .mode import Remember, ServiceMode

DONE, REFUSED, CANNOT = 0, 1, 2
ANSWER_LIMIT_S = 2.0
ORDERS = {"enter": OrderServiceModeRequest.ENTER, "release": OrderServiceModeRequest.RELEASE}
QUESTION = ("See that nobody works at mast, lift, servos or wheels, and that tools and covers are in place. Then type "
            "release: ")
NOT_STARTED = "Service mode cannot be ordered: no robot runs here."
NOT_CONFIRMED = "Not released: the word was not typed."


class ServiceCalls:
    """Provides the service while the dispatcher runs."""

    def __init__(self, mode: ServiceMode, release_s: float):
        self._mode, self._release_s = mode, release_s
        self._service = rospy.Service(names.SERVICE_MODE_REQUEST, OrderServiceMode, self._order)

    def _order(self, request: OrderServiceModeRequest) -> OrderServiceModeResponse:
        if request.order == OrderServiceModeRequest.ENTER:
            self._mode.enter(problems.SERVICE_AT_ROBOT())
            rospy.logwarn("%s", self._mode.problem)
            return OrderServiceModeResponse(True, self._mode.problem.text)
        if request.order != OrderServiceModeRequest.RELEASE:
            return OrderServiceModeResponse(False, f"There is no order {request.order} of service mode.")
        refusal = self._mode.agree_at_robot(clock.steady_ns() * NS)
        rospy.logwarn("Release of service mode at the robot: %s", refusal or "accepted.")
        return OrderServiceModeResponse(not refusal, refusal.text or (
            f"Released at the robot for {self._release_s:.0f} s: the Operator has to agree in this time."))


def service_mode(parameters: Parameters) -> ServiceMode:
    """Service mode as it was when the robot's software ended."""
    recall, remember = _memory(parameters)
    if recall:
        rospy.logwarn("%s", problems.SERVICE_MODE(cause=recall))
    return ServiceMode(parameters.service_release_s, recall, remember)


def _memory(parameters: Parameters) -> Tuple[Problem, Remember]:
    if parameters.simulated and not parameters.service_folder:
        return _recall_of_master(), _remember_at_master
    folder = pathlib.Path(parameters.service_folder or pathlib.Path(rospkg.get_ros_home()) / FOLDER_NAME)
    file = ServiceFile(folder)
    return file.recall(), file.remember


def _recall_of_master() -> Problem:
    known = rospy.get_param(names.SERVICE_MODE_IN_FORCE, None)
    is_of_this_run = isinstance(known, dict) and known.get("run") == str(rospy.get_param(names.ROBOT_RUN, ""))
    return recalled(known) if is_of_this_run else NO_PROBLEM


def _remember_at_master(is_active: bool) -> None:
    run = str(rospy.get_param(names.ROBOT_RUN, ""))
    rospy.set_param(names.SERVICE_MODE_IN_FORCE, {"run": run, "service_mode": is_active})


def main(arguments: Optional[List[str]] = None) -> int:
    """Order service mode at the robot; the exit status: 0 done, 1 refused, 2 nobody to order."""
    parser = argparse.ArgumentParser(
        prog="service_mode", description="Disable wheels, lift and servos for work on the robot, or release them. "
        "Service mode ends when the Operator agrees, too, in the application.")
    parser.add_argument("order", choices=sorted(ORDERS))
    options = parser.parse_args(rospy.myargv(sys.argv)[1:] if arguments is None else arguments)
    if options.order == "release" and input(QUESTION).strip() != "release":
        print(NOT_CONFIRMED, file=sys.stderr)
        return REFUSED
    try:
        rospy.wait_for_service(names.SERVICE_MODE_REQUEST, ANSWER_LIMIT_S)
        answer = rospy.ServiceProxy(names.SERVICE_MODE_REQUEST, OrderServiceMode)(ORDERS[options.order])
    except (rospy.ROSException, rospy.ServiceException, OSError):
        print(NOT_STARTED, file=sys.stderr)
        return CANNOT
    print(answer.message, file=sys.stdout if answer.accepted else sys.stderr)
    return DONE if answer.accepted else REFUSED
