"""Life of a node from its parameters to its exit status, the same for all."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import gc
import io
import sys
from typing import Any, Callable, Type, TypeVar

import rospy

from mtr_core import names
from mtr_core.errors import RobotError
from mtr_core.parameters import ParameterSet, described, parameters_from

P = TypeVar("P", bound=ParameterSet)

CANNOT_START = 2


def run_node(name: str, parameter_type: Type[P], make: Callable[[P], Any], **options: Any) -> int:
    """Make the node from its private parameters and let it spin() until shutdown.

    Returns the exit status: 0 after Ctrl-C, 2 after one sentence when the node cannot start. The options are those of
    rospy.init_node.
    """
    # What is logged to a file or the journal must not wait until 8 kB of it are together: it is lost with the process.
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(line_buffering=True)
    rospy.init_node(name, **options)
    try:
        parameters = parameters_from(rospy.get_param("~", {}), parameter_type)
        rospy.loginfo("Parameters: %s", described(parameters))
        node = make(parameters)
    except RobotError as error:
        rospy.logfatal("The node %s cannot start. %s", name, error)
        _tell_failure(str(error))
        return CANNOT_START
    _tell_failure("")
    _spare_collections()
    try:
        node.spin()
    except rospy.ROSException:
        # A shutdown wakes whoever sleeps and closes the topics of whoever publishes.
        if not rospy.is_shutdown():
            raise
    return 0


def _spare_collections() -> None:
    """Have collections of garbage look at nothing that there is now: some 50,000 objects, most of them imported.

    A full one took 39 to 59 ms of processor time (26 November 2026, a busy machine), in which no thread of the node
    goes on: longer than a period of the planner and of the manual controller.
    """
    gc.collect()
    gc.freeze()


def _tell_failure(why: str) -> None:
    """Keep for the Operator why this node cannot start; nothing when it has. A log may be lost with the process."""
    parameter = f"{names.START_FAILURES}/{rospy.get_name().lstrip('/')}"
    # A master that is gone ends all nodes anyway.
    with contextlib.suppress(OSError, rospy.ROSException):
        if why:
            rospy.set_param(parameter, why)
        elif rospy.has_param(parameter):
            rospy.delete_param(parameter)
