"""The dispatcher's node: wires the link and the topics to the core."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import secrets
import time
from dataclasses import replace
from typing import Callable, Counter, List, Mapping, Optional

import rospkg
import rospy
from rosgraph_msgs.msg import Log

from mtr_core import names, schedule
from mtr_core.liveness import NS, ClockWatch
from mtr_core.lockstep import Ticker, TickInput, clock, publisher, run_node
from mtr_core.quiet_log import Throttle
from mtr_description.robot_description import described_robot
from mtr_msgs.msg import (
    CarCheck,
    CarEstimate,
    DesiredState,
    DriveStatus,
    LocalizedPose,
    MotionLock,
    MotionStatus,
    PeripheralsState,
    RobotMode,
    TestArea,
)

from .access.admission import admission
from .access.connection_watch import HANDSHAKE_FAILURES
from .access.curve import is_possible
from .access.gate import ANYBODY, Gate
from .access.rates import Rates
from .area.keeper import AreaKeeper
from .area.order import corners_from
from .conversions import area_message, desired_message, lock_message, service_lock_messages
from .core import Dispatcher
from .disks.watch import DiskWatch
from .link_server import LinkError, LinkServer, Ports, Received
from .master_watch import MasterWatch
from .memory import end_beyond, give_back, resident_mib
from .operator_wait import OperatorWait, Unread
from .parameters import Parameters
from .sensors import Eyes, mounted_lidars
from .service.service_call import ServiceCalls, service_mode
from .session import CommandResult, SessionState, is_same
from .status.builder import Identity
from .status.emergency import EmergencyWatch
from .status.inputs import STALE_AFTER_S, Inputs
from .status.notices import ERROR, WARNING
from .status.texts import cut

# While simulated time waits for the application, the Status is repeated for one that connects meanwhile.
STATUS_AGAIN_WALL_S = 0.1
# Longest wait on the robot's own clock, which bounds the delay of a confirmation.
TURN_S = 0.02
# Period of the log per kind of bad message, so that a flood does not fill it.
LOG_PERIOD_S = 10.0
# New Commands of one owner that are logged individually; a test has a few per second.
LOGGED_PER_S, MAX_LOGGED_BURST = 5.0, 50.0


class DispatcherNode:
    """Serves the link at the ticks of simulated time, or at once on the robot's own clock."""

    def __init__(self, parameters: Parameters, core: Dispatcher, server: LinkServer, eyes: Eyes,
                 gate: Optional[Gate] = None):
        """gate: access control of the link; None if the link is not encrypted."""
        self._parameters, self._core, self._server, self._gate = parameters, core, server, gate
        self._eyes = eyes
        self._refused = 0
        self._cut_off: Counter[str] = Counter()
        self._logged = Rates(LOGGED_PER_S, MAX_LOGGED_BURST)
        self._wait = OperatorWait(parameters.operator_lost_after_wall_s)
        self._unread: Unread[Received] = Unread(server.receive)
        self._published: Optional[SessionState] = None
        self._confirmed: Optional[List[object]] = None
        self._status = b""
        self._clock_watch, self._throttle = ClockWatch(), Throttle(LOG_PERIOD_S)
        self._emergency = EmergencyWatch(parameters.emergency_stop)
        self._master = MasterWatch(lambda parameter: rospy.get_param(parameter, None))
        self._master.start()
        self._service = ServiceCalls(core.service, parameters.service_release_s)
        self._disks = DiskWatch(_written_folders(parameters), parameters.full_disk_mb, parameters.disk_period_s)
        self._disks.start()
        self._topics = (
            TickInput(names.LOCALIZED_POSE, LocalizedPose, schedule.LOCALIZATION, lag_ns=0),
            TickInput(names.CAR_ESTIMATE, CarEstimate, schedule.CAR_LOCATOR),
            TickInput(names.ROBOT_MODE, RobotMode, schedule.STATE_MACHINE),
            TickInput(names.PERIPHERALS_STATE, PeripheralsState, schedule.PERIPHERALS),
            TickInput(names.CAR_CHECK, CarCheck, schedule.CAR_LOCATOR),
            TickInput(names.DRIVE_STATUS, DriveStatus, schedule.DRIVE_CONTROL),
            TickInput(names.MOTION_STATUS, MotionStatus, schedule.MOTION_PLANNER))
        self._desired = publisher(names.DESIRED_STATE, DesiredState)
        self._lock = publisher(names.MOTION_LOCK, MotionLock)
        self._area = rospy.Publisher(names.TEST_AREA, TestArea, queue_size=1, latch=True)
        self._locks = rospy.Subscriber(names.MOTION_LOCK, MotionLock, self._take_lock, queue_size=50)
        self._rosout = rospy.Subscriber("/rosout_agg", Log, self._take_log, queue_size=50)
        self._ticker = Ticker(schedule.DISPATCHER)

    def spin(self) -> None:
        """Run until shutdown."""
        turn = self._lockstep_turn if clock.is_lockstep() else self._real_turn
        try:
            while not rospy.is_shutdown():
                turn()
        finally:
            self._server.close()

    def _lockstep_turn(self) -> None:
        tick = self._ticker.sleep()
        if self._parameters.lockstep_operator:
            self._publish_status(tick)
            self._await_answer(tick)
        else:
            self._receive(tick, 0.0)
            self._publish_status(tick)
        self._publish_desired(tick)

    def _await_answer(self, tick: int) -> None:
        patient = not self._wait.operator_gone
        self._wait.begin()
        self._receive(tick, 0.0, self._is_answered)
        while not self._wait.is_over(self._core.session, self._core.status_id) and not rospy.is_shutdown():
            if not self._receive(tick, STATUS_AGAIN_WALL_S, self._is_answered):
                self._server.publish(self._status)
                # Renew the tick, so that the simulator does not mistake a waiting dispatcher for a dead one.
                self._ticker.renew()
        if patient and self._wait.operator_gone:
            rospy.logwarn("The application has not answered; time goes on until it is heard again.")

    def _is_answered(self) -> bool:
        return self._core.session.answered_status_id >= self._core.status_id

    def _real_turn(self) -> None:
        """Run one period of the steady clock, so that a step of the robot's clock does not prolong it."""
        now = clock.now_ns()
        end_ns = clock.steady_ns() + schedule.DISPATCHER.next_after(now) - now
        left_ns = end_ns - clock.steady_ns()
        while left_ns > 0 and not rospy.is_shutdown():
            self._receive(now, min(left_ns * NS, TURN_S))
            now = clock.now_ns()
            if not is_same(self._published, self._core.desired(self._steady_s(now))):
                self._publish_desired(now)
            inputs = self._inputs(now)
            if self._core.confirmed(inputs) != self._confirmed:
                self._publish_status(now, inputs)
            left_ns = end_ns - clock.steady_ns()
        self._bound_memory()
        self._publish_status(now)
        self._publish_desired(now)

    def _receive(self, now_ns: int, timeout_s: float, is_enough: Callable[[], bool] = lambda: False) -> bool:
        """Process arrived messages and return True if any came; those after is_enough wait for the next call."""
        self._watch_connections(self._steady_s(now_ns))
        if self._gate is not None:
            self._watch_keys(self._gate, self._steady_s(now_ns))
        has_come = self._unread.come(timeout_s)
        # Read the time after waiting: messages that came while this process was suspended count with their real age.
        now_s = self._steady_s(now_ns)
        for message in self._unread.until(is_enough):
            self._take(message, now_s)
        return has_come

    def _take(self, message: Received, now_s: float) -> None:
        sender = ANYBODY if self._gate is None else self._gate.sender(message.key, time.monotonic())
        result, sentence = self._core.receive(message.data, now_s, sender)
        if result in (CommandResult.TAKEN, CommandResult.REPEATED, CommandResult.REFUSED):
            self._wait.received()
        if not sentence:
            return
        is_good = result in (CommandResult.TAKEN, CommandResult.ENDED)
        if is_good and self._logged.allow(sender.name, time.monotonic()):
            rospy.loginfo("%s", sentence)
        else:
            self._warn(result, sentence)

    def _watch_connections(self, now_s: float) -> None:
        found, gate = self._server.cut_off(), self._gate
        for word in HANDSHAKE_FAILURES.values():
            # On a link without keys, failed handshakes are not refusals.
            failed = found.pop(word, 0)
            for _ in range(failed):
                if gate is not None:
                    gate.count(word)
        if found:
            self._cut_off += found
            self._warn("cut off", self._core.connections_cut_off(sum(self._cut_off.values()), now_s)
                       + f" {_listed(self._cut_off)}.")

    def _watch_keys(self, gate: Gate, now_s: float) -> None:
        refused = dict(gate.refused)
        if sum(refused.values()) != self._refused:
            self._refused = sum(refused.values())
            said = self._core.refused_connections(self._refused, now_s)
            self._warn("connections", f"{said} {_listed(refused)}.")
        if gate.has_lost_keys():
            rospy.logwarn("%s All connections are cut off, and the paired ones come back.", gate.why_lost())
            self._server.rebind()

    def _warn(self, kind: object, sentence: str) -> None:
        said = self._throttle.passed(kind, cut(sentence), time.monotonic())
        if said:
            rospy.logwarn(said)

    def _bound_memory(self) -> None:
        """Cut off all connections before strangers fill the memory: ZeroMQ bounds neither parts nor subscriptions."""
        used_mib = resident_mib()
        if used_mib <= self._parameters.memory_limit_mib:
            return
        rospy.logerr("Strangers fill the memory of the link: %.0f MiB; all connections are cut off.", used_mib)
        self._server.rebind()
        give_back()
        if resident_mib() > self._parameters.memory_limit_mib:
            raise LinkError(f"The link's memory stays above {self._parameters.memory_limit_mib} MiB.")

    @staticmethod
    def _steady_s(now_ns: int) -> float:
        return clock.steady_at(now_ns) * NS

    def _inputs(self, now_ns: int) -> Inputs:
        reading = clock.reading()
        self._clock_watch.update(reading)
        # Use the same reading: the application interprets a change between both clocks as a step of the robot's clock.
        steady_s = reading.steady_of(now_ns) * NS
        pose, car, mode, peripherals, check, drive, motion = (
            topic.fresh_at(now_ns, STALE_AFTER_S) for topic in self._topics)
        return Inputs(now_ns * NS, pose, car, mode, peripherals, check, drive, motion, steady_s,
                      self._clock_watch.steps, self._emergency.at(steady_s), self._master.failures,
                      preflight=self._master.preflight, full_disk=self._disks.full)

    def _publish_status(self, now_ns: int, inputs: Optional[Inputs] = None) -> None:
        inputs = inputs or self._inputs(now_ns)
        inputs = inputs._replace(surroundings=self._eyes.look(inputs))
        self._confirmed = self._core.confirmed(inputs)
        self._status = self._core.status(inputs)
        self._server.publish(self._status)

    def _publish_desired(self, now_ns: int) -> None:
        desired = self._core.desired(self._steady_s(now_ns))
        if self._published is None or desired.stop_reason != self._published.stop_reason:
            rospy.loginfo("Motion %s", f"locked: {desired.stop_reason}" if desired.stop_reason else "allowed.")
        stamp = clock.stamp_of(now_ns)
        # First: who has received the dispatcher's lock knows of service mode, too.
        for message in service_lock_messages(self._published, desired, stamp):
            self._lock.publish(message)
        self._lock.publish(lock_message(desired, stamp))
        area_problem = self._core.area_problem(self._topics[0].fresh_at(now_ns, STALE_AFTER_S))
        self._area.publish(area_message(self._core.areas, stamp))
        self._desired.publish(desired_message(desired, stamp, self._parameters.default_speed_mps, area_problem))
        self._published = desired
        # After the lock, which does not wait for the disk, and before a Status says that the mode is active.
        self._core.service.store()

    def _take_lock(self, message: MotionLock) -> None:
        if message.emergency and message.owner != names.SERVICE_MODE:
            self._emergency.received(message.owner, message.engaged, clock.steady_ns() * NS)

    def _take_log(self, message: Log) -> None:
        if message.level >= Log.WARN:
            severity = WARNING if message.level == Log.WARN else ERROR
            self._core.log.add(message.header.stamp.to_sec(), severity, message.name.lstrip("/"), message.msg)


def _listed(counts: Mapping[str, int]) -> str:
    return ", ".join(f"{count} {what}" for what, count in counts.items())


def _written_folders(parameters: Parameters) -> List[pathlib.Path]:
    """Return the folders that nodes of this robot write to by themselves, from their common environment."""
    folders = (rospkg.get_ros_home(), rospkg.get_log_dir(), parameters.memory_folder)
    return [pathlib.Path(folder) for folder in folders if folder]


def _areas(parameters: Parameters) -> AreaKeeper:
    """Return the keeper of the test area, which survives a restart of this process within one robot run."""
    run = str(rospy.get_param(names.ROBOT_RUN, ""))
    known = rospy.get_param(names.TEST_AREA_IN_FORCE, {})
    remembered = known.get("area") if run and isinstance(known, dict) and known.get("run") == run else None
    return AreaKeeper(not parameters.simulated, corners_from(parameters.test_area_xy), remembered,
                      lambda area: rospy.set_param(names.TEST_AREA_IN_FORCE, {"run": run, "area": area}))


def make(parameters: Parameters) -> DispatcherNode:
    """Return the node with its ports open."""
    # The Status must report the actual value.
    parameters = replace(parameters, lockstep_operator=parameters.lockstep_operator and clock.is_lockstep())
    robot = described_robot()
    key = robot.key()
    end_beyond(parameters.memory_limit_mib)
    if parameters.is_encrypted and not is_possible():
        raise LinkError(f"The link cannot listen on {parameters.bind_address}: this ZeroMQ has no encryption; install "
                        "one with it, bind 127.0.0.1, or set allow_unencrypted.")
    curve, gate = admission(parameters, pathlib.Path(rospkg.get_ros_home()), rospy.loginfo, rospy.logerr)
    server = LinkServer(Ports(parameters.bind_address, parameters.status_port, parameters.command_port), curve)
    server.bind()
    try:
        # A preflight reads the folders here, because its own environment may differ.
        rospy.set_param(names.WRITTEN_FOLDERS, [str(folder) for folder in _written_folders(parameters)])
        identity = Identity(secrets.randbits(63) | 1, rospkg.RosPack().get_manifest("mtr_dispatcher").version,
                            key.x_m, key.y_m)
        return DispatcherNode(parameters, Dispatcher(parameters, identity, _areas(parameters),
                                                     service_mode(parameters)), server,
                              Eyes(mounted_lidars(robot)), gate)
    except BaseException:
        # The server's thread would keep the process alive.
        server.close()
        raise


def main() -> int:
    """Run the node and return its exit status."""
    return run_node("dispatcher", Parameters, make)
