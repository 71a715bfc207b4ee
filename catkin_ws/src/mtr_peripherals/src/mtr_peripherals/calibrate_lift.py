"""Orders the firmware to calibrate the lift by driving to both stops, and prints the result in one sentence."""
# SPDX-License-Identifier: Apache-2.0
import argparse
import sys
from typing import List, Optional, Tuple

import rosgraph
import rospy

from mtr_core import names
from mtr_core.crc import is_sound, seal
from mtr_core.errors import ConfigurationError
from mtr_msgs.msg import FirmwareCalibrate, FirmwareState

from .lift_calibration import ANSWER_WITHIN_S, PERIOD_S, Calibration, Order, Report, order_of


def message_of(order: Order) -> FirmwareCalibrate:
    """The order with its checksum."""
    return seal(FirmwareCalibrate(id=order.id, stroke_m=order.stroke_m, latest_us=order.latest_us))


class NewestState:
    """Newest sound report of the firmware."""

    def __init__(self) -> None:
        self.report: Optional[Report] = None

    def take(self, message: FirmwareState) -> None:
        """Store a valid report."""
        if is_sound(message):
            self.report = Report(message.calibration_id, message.calibration_state, message.time_us)


def main(arguments: Optional[List[str]] = None) -> int:
    """Calibrate the lift; return 0 on success."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("stroke_m", type=float, help="m between the lift's stops, measured by hand")
    parser.add_argument("--dry-run", action="store_true", help="only print the order")
    options = parser.parse_args(rospy.myargv(arguments)[1:])
    try:
        example = order_of(options.stroke_m, last_id=0)
    except ConfigurationError as error:
        print(error, file=sys.stderr)
        return 1
    if options.dry_run:
        print(message_of(example))
        return 0
    print("Watch the lift: whatever stops it on its way is taken for a stop. Ctrl-C stops it.")
    rospy.init_node("calibrate_lift", anonymous=True, disable_signals=True)
    try:
        done, sentence = calibrate(options.stroke_m)
    except KeyboardInterrupt:
        done, sentence = False, "Stopped by you; what the firmware knew before stays."
    print(sentence, file=sys.stdout if done else sys.stderr)
    return 0 if done else 1


def calibrate(stroke_m: float) -> Tuple[bool, str]:
    """Run the calibration on the node's topics."""
    newest = NewestState()
    publisher = rospy.Publisher(names.FIRMWARE_CALIBRATE, FirmwareCalibrate, queue_size=1)
    rospy.Subscriber(names.FIRMWARE_STATE, FirmwareState, newest.take, queue_size=1)
    if not is_heard_by_all(publisher):
        return False, "Not all listeners of the order have connected, so nothing was ordered; look at the network."
    calibration = Calibration(lambda order: publisher.publish(message_of(order)), lambda: newest.report, rospy.sleep)
    return calibration.run(stroke_m)


def is_heard_by_all(publisher: rospy.Publisher) -> bool:
    """Wait for all subscribers, because the peripherals node aborts a calibration whose orders it does not receive."""
    subscribers = dict(rosgraph.Master(rospy.get_name()).getSystemState()[1])
    wanted = len(subscribers.get(publisher.resolved_name, []))
    for _ in range(round(ANSWER_WITHIN_S / PERIOD_S)):
        if publisher.get_num_connections() >= wanted:
            return True
        rospy.sleep(PERIOD_S)
    return False
