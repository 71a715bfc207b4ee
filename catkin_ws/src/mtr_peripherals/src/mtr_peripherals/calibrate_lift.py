"""Orders the firmware to drive the lift to both stops and remember them, and says in one sentence what became of it."""
# SPDX-License-Identifier: Apache-2.0
import argparse
import sys
from typing import Callable, List, Optional, Tuple

import rospy

from mtr_core import names
from mtr_core.crc import is_sound, seal
from mtr_core.errors import ConfigurationError
from mtr_core.parameters import check_range
from mtr_msgs.msg import FirmwareCalibrate, FirmwareState

UNDER_WAY, DONE, REFUSED = 1, 2, 3
# Of FirmwareCalibrate.stroke_m.
LEAST_STROKE_M, LARGEST_STROKE_M = 0.05, 2.0
PERIOD_S, ANSWER_WITHIN_S = 0.1, 3.0
# Down and up at the lift's slow speed, with room.
DONE_WITHIN_S = 180.0

State = Callable[[], Optional[FirmwareState]]


def order_of(stroke_m: float, last_id: int) -> FirmwareCalibrate:
    """Sealed order with an id that the firmware has not seen last; ConfigurationError names a stroke out of range."""
    check_range("stroke", stroke_m, LEAST_STROKE_M, LARGEST_STROKE_M, "m")
    return seal(FirmwareCalibrate(id=last_id % (2 ** 32 - 1) + 1, stroke_m=stroke_m))


def verdict_of(state: Optional[FirmwareState], wanted_id: int, waited_s: float) -> Optional[Tuple[bool, str]]:
    """Whether the calibration has succeeded, with a sentence; None while it is not known yet."""
    if state is None or state.calibration_id != wanted_id:
        return (False, "The firmware has not taken the order.") if waited_s > ANSWER_WITHIN_S else None
    if state.calibration_state == DONE:
        return True, "The lift is calibrated."
    if state.calibration_state == REFUSED:
        return False, "The firmware has refused the calibration, or it has failed; what it knew before stays."
    if waited_s > DONE_WITHIN_S:
        return False, f"The calibration has not ended within {DONE_WITHIN_S:.0f} s; look at the lift."
    return None


class Calibration:
    """Repeats the order until the firmware answers."""

    def __init__(self, publish: Callable[[FirmwareCalibrate], None], state: State, sleep: Callable[[float], None]):
        self._publish, self._state, self._sleep = publish, state, sleep

    def run(self, stroke_m: float) -> Tuple[bool, str]:
        """Whether it has succeeded, with a sentence."""
        for _ in range(round(ANSWER_WITHIN_S / PERIOD_S)):
            if self._state() is not None:
                break
            self._sleep(PERIOD_S)
        else:
            return False, "The firmware is silent, so nothing was ordered."
        order, waited_s = order_of(stroke_m, self._state().calibration_id), 0.0
        while True:
            verdict = verdict_of(self._state(), order.id, waited_s)
            if verdict:
                return verdict
            if self._state().calibration_id != order.id:
                self._publish(order)
            self._sleep(PERIOD_S)
            waited_s += PERIOD_S


class NewestState:
    """Newest sound report of the firmware."""

    def __init__(self) -> None:
        self.message: Optional[FirmwareState] = None

    def take(self, message: FirmwareState) -> None:
        """A report has come."""
        if is_sound(message):
            self.message = message


def main(arguments: Optional[List[str]] = None) -> int:
    """Calibrate; 0 when the lift is calibrated."""
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
        print(example)
        return 0
    print("Watch the lift: whatever stops it on its way is taken for a stop.")
    rospy.init_node("calibrate_lift", anonymous=True)
    newest = NewestState()
    publisher = rospy.Publisher(names.FIRMWARE_CALIBRATE, FirmwareCalibrate, queue_size=1)
    rospy.Subscriber(names.FIRMWARE_STATE, FirmwareState, newest.take, queue_size=1)
    done, sentence = Calibration(publisher.publish, lambda: newest.message, rospy.sleep).run(options.stroke_m)
    print(sentence, file=sys.stdout if done else sys.stderr)
    return 0 if done else 1
