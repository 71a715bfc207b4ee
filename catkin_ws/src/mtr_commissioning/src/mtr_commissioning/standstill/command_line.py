"""Report if the robot may be stopped for an update; exit status 0: yes, 4: no, 3: it does not answer."""
# SPDX-License-Identifier: Apache-2.0
import os

import rospy
from nav_msgs.msg import Odometry

from mtr_core import names
from mtr_core.liveness import NS
from mtr_core.lockstep import clock
from mtr_graph_watch.environment import join_on_loopback
from mtr_graph_watch.master import master_answers
from mtr_msgs.msg import DriveStatus, MotionLock

from .judge import WATCHED_S, Answer, Lock, StandstillJudge, Velocity, Verdict

# Connections to the publishers last up to a second on a busy computer.
LISTENED_S = 3.0 * WATCHED_S


def main() -> int:
    """Record for some time and print the answer."""
    join_on_loopback(os.environ)
    answer = listened() if master_answers() else Answer(Verdict.SILENT, "There is no ROS master.")
    print(answer.sentence)
    return answer.verdict.value


def listened() -> Answer:
    """Return the verdict on the reports of the running nodes."""
    rospy.init_node("standstill", anonymous=True, disable_signals=True)
    judge = StandstillJudge()

    def take_status(message: DriveStatus) -> None:
        judge.take_command(Velocity(_now_s(), message.linear_mps, message.angular_radps))

    def take_odometry(message: Odometry) -> None:
        judge.take_odometry(Velocity(_now_s(), message.twist.twist.linear.x, message.twist.twist.angular.z))

    def take_lock(message: MotionLock) -> None:
        judge.take_lock(message.owner, Lock(_now_s(), message.engaged, message.emergency))

    odometry = rospy.get_param("/robot_topics/wheel_odometry", names.WHEEL_ODOMETRY)
    subscribers = [rospy.Subscriber(names.DRIVE_STATUS, DriveStatus, take_status, queue_size=100),
                   rospy.Subscriber(odometry, Odometry, take_odometry, queue_size=100),
                   rospy.Subscriber(names.MOTION_LOCK, MotionLock, take_lock, queue_size=100)]
    rospy.rostime.wallsleep(LISTENED_S)
    answer = judge.answer(_now_s())
    for subscriber in subscribers:
        subscriber.unregister()
    return answer


def _now_s() -> float:
    return clock.steady_ns() * NS
