"""What surrounds drive control, on the machine's own clock: a base that obeys, sensors, lock owners and a planner."""
# SPDX-License-Identifier: Apache-2.0
import threading
import time
from typing import List, Tuple

import rospy
from geometry_msgs.msg import Twist
from scripted_sensors import open_ground
from scripted_time import NS, Speaker

from mtr_core import names, schedule
from mtr_description.shipped import shipped_base
from mtr_msgs.msg import MotionLock, RobotMode, VelocityCommand

PERIOD_S = 0.02
CRUISE_MPS = 0.7
BASE = shipped_base()


class LiveRobot:
    """Speaks 50 times a second from a thread of its own; everything that it knows may be read at any time.

    Attributes:
        planner, dispatcher, front: speakers whose message a test may change.
        speakers: who speaks; a test may add one.
        speed_mps: of the wheels; they follow the last command as the shipped base does, time-out included.
        commands: arrival by time.monotonic() and speed of each command to the wheels.
    """

    def __init__(self) -> None:
        self.front, rear, self.odometry, imu, peripherals = open_ground()
        self.planner = Speaker(names.PLANNER_VELOCITY, VelocityCommand(), schedule.MOTION_PLANNER)
        self.dispatcher = Speaker(names.MOTION_LOCK, MotionLock(owner="dispatcher"), schedule.DISPATCHER)
        state_machine = Speaker(names.MOTION_LOCK, MotionLock(owner="state_machine"), schedule.STATE_MACHINE)
        # The Command's speed.
        mode = Speaker(names.ROBOT_MODE, RobotMode(max_speed_mps=2.0), schedule.STATE_MACHINE)
        self.speed_mps = 0.0
        self.commands: List[Tuple[float, float]] = []
        self.speakers = [self.front, rear, self.odometry, imu, peripherals, self.planner, self.dispatcher,
                         state_machine, mode]
        self._over = threading.Event()
        self._subscriber = rospy.Subscriber(names.WHEEL_COMMAND, Twist, self._take, queue_size=50, tcp_nodelay=True)
        self._thread = threading.Thread(target=self._run, daemon=True)

    def start(self) -> None:
        """Begin to speak."""
        self._thread.start()

    def close(self) -> None:
        """Fall silent."""
        self._over.set()
        self._thread.join()

    def _take(self, twist: Twist) -> None:
        self.commands.append((time.monotonic(), twist.linear.x))

    def _run(self) -> None:
        before_s, tick_ns = time.monotonic(), next_tick_ns()
        while not self._over.wait((tick_ns - rospy.Time.now().to_nsec()) * NS):
            now_s = time.monotonic()
            self._roll(now_s, now_s - before_s)
            before_s = now_s
            for speaker in self.speakers:
                speaker.speak(tick_ns)
            tick_ns = next_tick_ns()

    def _roll(self, now_s: float, step_s: float) -> None:
        is_told = bool(self.commands) and now_s - self.commands[-1][0] < BASE.command_timeout_s
        wanted_mps = self.commands[-1][1] if is_told else 0.0
        most_mps = BASE.linear_acceleration_mps2 * step_s
        self.speed_mps += min(max(wanted_mps - self.speed_mps, -most_mps), most_mps)
        rolled = Twist()
        rolled.linear.x = self.speed_mps
        self.odometry.obey(rolled)


def next_tick_ns() -> int:
    """Tick that comes next on the machine's clock."""
    return schedule.SENSORS.next_after(rospy.Time.now().to_nsec())


def wait_until(condition, what: str, within_s: float = 20.0) -> None:
    """Wait, by wall time; AssertionError when it takes longer."""
    deadline_s = time.monotonic() + within_s
    while not condition():
        if time.monotonic() > deadline_s:
            raise AssertionError(f"It did not come to pass within {within_s:g} s: {what}.")
        time.sleep(PERIOD_S / 4.0)
