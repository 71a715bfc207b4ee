"""Node fault_injection: a service for requests, relays of the sensors' topics, and control of all other faults."""
# SPDX-License-Identifier: Apache-2.0
import os
import threading
from typing import Any, Callable, Dict, List, NamedTuple, Optional

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import BatteryState, Imu, LaserScan, NavSatFix

from mtr_core import names
from mtr_core.liveness import NS
from mtr_core.lockstep import clock, direct_publisher, run_node
from mtr_msgs.msg import ActiveFault, ActiveFaults, FirmwareState
from mtr_msgs.srv import InjectFault, InjectFaultResponse

from . import parts
from .link.relay import PortRelay
from .link.second_operator import SecondOperator
from .machine import BusyProcessor, FullDisk
from .parameters import Parameters
from .parts import NONE, FaultError, Kind, Place
from .processes import ProcessFault, process_of
from .schedule import Fault, Schedule, fault_of
from .set_clock import ClockFile
from .spoiling import Spoiler

LOOPBACK = "127.0.0.1"
# Period in which ends of faults are checked; wall time, because a fault may stop simulated time.
TURN_S = 0.01


class _Relayed(NamedTuple):
    """Relayed topic of a sensor. source: topic of the driver; name: topic of the sensor without faults."""

    part: str
    source: str
    name: str
    message_type: Any


def relayed_topic(name: str) -> str:
    """Return the topic that the nodes use if faults can be injected; robot.launch configures them so."""
    return f"{names.FAULT_INJECTION}{name}"


class FaultInjectionNode:
    """Inactive unless the robot was started for it; each fault is logged as a warning, which is shown to the
    Operator."""

    def __init__(self, parameters: Parameters):
        self._parameters, self._schedule, self._lock = parameters, Schedule(), threading.RLock()
        self._undo: Dict[str, Callable[[], None]] = {}
        self._active = rospy.Publisher(names.ACTIVE_FAULTS, ActiveFaults, queue_size=10, latch=True)
        self._tell()
        self._relays = self._relayed_topics()
        self._ports = self._relayed_ports()
        rospy.set_param(names.FAULT_CATALOGUE, parts.catalogue())
        rospy.logwarn("Faults can be injected into this robot (fault_injection:=true).")
        self._service = rospy.Service(names.INJECT_FAULT, InjectFault, self._inject)

    def spin(self) -> None:
        """End expired faults until shutdown, then all."""
        try:
            while not rospy.is_shutdown():
                with self._lock:
                    self._end(self._schedule.ended(self._now_s()))
                rospy.rostime.wallsleep(TURN_S)
        finally:
            with self._lock:
                self._end([fault for each in self._schedule.active for fault in self._schedule.end(each.part.name)])
            for port in self._ports:
                port.close()

    @staticmethod
    def _now_s() -> float:
        return clock.steady_ns() * NS

    def _inject(self, request: Any) -> InjectFaultResponse:
        with self._lock:
            try:
                if request.kind == NONE:
                    ended = self._schedule.end(request.part)
                    self._end(ended)
                    return InjectFaultResponse(True, f"The part {request.part} "
                                                     f"{'works again' if ended else 'had no fault'}.")
                fault = fault_of(request.part, request.kind, request.duration_s, request.amount, self._now_s())
                self._schedule.begin(fault)
                try:
                    self._begin(fault)
                except FaultError:
                    self._schedule.end(fault.part.name)
                    raise
            except FaultError as error:
                return InjectFaultResponse(False, str(error))
            self._tell()
        sentence = f"Injected: {fault} for {request.duration_s:g} s."
        rospy.logwarn("%s", sentence)
        return InjectFaultResponse(True, sentence)

    def _begin(self, fault: Fault) -> None:
        name, place = fault.part.name, fault.part.place
        if place is Place.SIMULATOR and not self._parameters.simulated:
            raise FaultError(f"The part {name} can have faults in simulation only; on a robot pull its plug.")
        if place is Place.NODE:
            process = ProcessFault(fault.kind, lambda: [process_of(os.environ["ROS_MASTER_URI"], name)])
            self._undo[name] = process.end
        elif place is Place.MACHINE:
            self._undo[name] = self._machine(fault)
        elif name == parts.OPERATOR:
            told = self._parameters
            operator = SecondOperator(fault.kind, LOOPBACK, told.status_port, told.command_port, told.seed)
            self._undo[name] = operator.end
        elif place is Place.LINK and not self._ports:
            raise FaultError("There is no relay of the link; set relay_status_port and relay_command_port.")

    def _machine(self, fault: Fault) -> Callable[[], None]:
        if fault.part.name == parts.DISK:
            return FullDisk(self._parameters.disk_folder, self._parameters.disk_limit_mib).end
        if fault.part.name == parts.CPU:
            return BusyProcessor().end if fault.kind is Kind.SLOW else ProcessFault(Kind.STOP, self._processes).end
        nodes_clock = ClockFile(self._parameters.clock_file)
        step_s = fault.amount if fault.kind is Kind.FORWARD else -fault.amount
        nodes_clock.set_by(step_s)
        return lambda: nodes_clock.set_by(-step_s)

    @staticmethod
    def _processes() -> List[int]:
        """Return the processes of all running nodes."""
        found = []
        for node in parts.NODES:
            try:
                found.append(process_of(os.environ["ROS_MASTER_URI"], node))
            except FaultError:
                continue
        return found

    def _end(self, faults: List[Fault]) -> None:
        for fault in faults:
            self._undo.pop(fault.part.name, lambda: None)()
            rospy.logwarn("Injected fault over: %s.", fault)
        if faults:
            self._tell()

    def _tell(self) -> None:
        message = ActiveFaults(faults=[
            ActiveFault(fault.part.name, fault.kind.value, fault.amount,
                        rospy.Time.now() + rospy.Duration(max(fault.until_s - self._now_s(), 0.0)))
            for fault in self._schedule.active])
        message.header.stamp = rospy.Time.now()
        self._active.publish(message)

    def _current(self, part: str) -> Optional[Fault]:
        return self._schedule.of(part)

    def _relayed_topics(self) -> List[Any]:
        told = self._parameters
        topics = (_Relayed("front_lidar", told.front_scan, names.FRONT_SCAN, LaserScan),
                  _Relayed("rear_lidar", told.rear_scan, names.REAR_SCAN, LaserScan),
                  _Relayed("imu", told.imu_data, names.IMU_DATA, Imu),
                  _Relayed("odometry", told.wheel_odometry, names.WHEEL_ODOMETRY, Odometry),
                  _Relayed("gnss", told.navsat_fix, names.NAVSAT_FIX, NavSatFix),
                  _Relayed("battery", told.battery, names.BATTERY, BatteryState),
                  _Relayed("board", told.firmware_state, names.FIRMWARE_STATE, FirmwareState))
        return [self._relay(topic, told.seed + number) for number, topic in enumerate(topics)]

    def _relay(self, topic: _Relayed, seed: int) -> Any:
        out, spoiler = direct_publisher(relayed_topic(topic.name), topic.message_type), Spoiler(seed)

        def take(message: Any) -> None:
            now_s = self._now_s()
            fault = self._current(topic.part)
            for each in spoiler.passed(message, fault if fault and now_s < fault.until_s else None, now_s):
                out.publish(each)
        return rospy.Subscriber(topic.source, topic.message_type, take, queue_size=50, tcp_nodelay=True)

    def _relayed_ports(self) -> List[PortRelay]:
        told = self._parameters
        if not (told.relay_status_port and told.relay_command_port):
            return []

        def of(part: str) -> Callable[[], Optional[Fault]]:
            return lambda: self._current(part)

        def nothing() -> Optional[Fault]:
            return None
        return [PortRelay((LOOPBACK, told.relay_status_port), (LOOPBACK, told.status_port), nothing,
                          of(parts.LINK_STATUSES)),
                PortRelay((LOOPBACK, told.relay_command_port), (LOOPBACK, told.command_port), of(parts.LINK_COMMANDS),
                          nothing)]


def main() -> int:
    """Run the node; return its exit status."""
    return run_node("fault_injection", Parameters, FaultInjectionNode)
