"""The command `rosrun mtr_fault_injection inject`."""
# SPDX-License-Identifier: Apache-2.0
import argparse
import sys
from typing import List, Optional

import rospy

from mtr_core import names
from mtr_msgs.srv import InjectFault

from .parts import NONE, PARTS, USUAL_AMOUNTS

DONE, REFUSED, CANNOT = 0, 1, 2
SERVICE_LIMIT_S = 2.0
DEFAULT_S = 1.0
NOT_STARTED = ("Faults cannot be injected: no robot runs here that was started with fault_injection:=true.")


def listed() -> str:
    """Return all parts with their kinds of fault, one line each."""
    return "\n".join(f"  {part.name:<18}{', '.join(kind.value for kind in part.kinds)}" for part in PARTS.values())


def main(arguments: Optional[List[str]] = None) -> int:
    """Request a fault from the node; return the exit status: 0 done, 1 refused, 2 the node is not running."""
    usual = ", ".join(f"{kind.value} {amount:g}" for kind, amount in USUAL_AMOUNTS.items())
    parser = argparse.ArgumentParser(prog="inject", formatter_class=argparse.RawDescriptionHelpFormatter,
                                     description="Lets a part of the running robot have a fault for a while.",
                                     epilog=f"parts and what they can have:\n{listed()}")
    parser.add_argument("part", help="see below")
    parser.add_argument("kind", help=f"see below; {NONE} ends the fault")
    parser.add_argument("--for", dest="duration_s", type=float, default=DEFAULT_S, metavar="S",
                        help=f"how long, s of the robot's time; default {DEFAULT_S:g}")
    parser.add_argument("--by", dest="amount", type=float, default=0.0, metavar="X",
                        help=f"s of a delay or step, share of lost messages; usual: {usual}")
    options = parser.parse_args(rospy.myargv(sys.argv)[1:] if arguments is None else arguments)
    try:
        rospy.wait_for_service(names.INJECT_FAULT, SERVICE_LIMIT_S)
        answer = rospy.ServiceProxy(names.INJECT_FAULT, InjectFault)(
            options.part, options.kind, options.duration_s, options.amount)
    except (rospy.ROSException, rospy.ServiceException, OSError):
        print(NOT_STARTED, file=sys.stderr)
        return CANNOT
    print(answer.message, file=sys.stdout if answer.accepted else sys.stderr)
    return DONE if answer.accepted else REFUSED
