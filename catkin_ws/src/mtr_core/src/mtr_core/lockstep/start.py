"""Life cycle of a node from its parameters to its exit status, common to all nodes."""
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
    """Construct the node from its private parameters and run spin() until shutdown.

    Returns the exit status: 0 after Ctrl-C, 2 after one sentence if the node cannot start. The options are passed to
    rospy.init_node.
    """
    # Log lines to a file or the journal must not wait in a buffer of 8 kB, which is lost with the process.
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
        # A shutdown interrupts sleeping threads and closes topics during publishing.
        if not rospy.is_shutdown():
            raise
    return 0


def _spare_collections() -> None:
    """Exclude all current objects from garbage collection: about 50,000 objects, most of them imported.

    A full collection needed 39 to 59 ms of processor time (26 November 2026, a busy machine), in which all threads of
    the node are blocked. This exceeds a period of the planner and of the manual controller.
    """
    gc.collect()
    gc.freeze()


def _tell_failure(why: str) -> None:
    """Store for the Operator why this node cannot start; delete it otherwise. A log may be lost with the process."""
    parameter = f"{names.START_FAILURES}/{rospy.get_name().lstrip('/')}"
    # Without a master all nodes end anyway.
    with contextlib.suppress(OSError, rospy.ROSException):
        if why:
            rospy.set_param(parameter, why)
        elif rospy.has_param(parameter):
            rospy.delete_param(parameter)
