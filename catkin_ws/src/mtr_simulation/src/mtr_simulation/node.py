"""Simulator as a ROS node: publishes sensors and /clock, subscribes to the topics of the base and the firmware."""
# SPDX-License-Identifier: Apache-2.0
import collections
import contextlib
import math
import threading
from typing import Any, Callable, Deque, Iterable, List, Optional, Set, Tuple

import rosgraph
import rospy
from geometry_msgs.msg import Pose2D, Twist
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from rospy.exceptions import TransportException
from sensor_msgs.msg import BatteryState, Imu
from std_msgs.msg import Bool, Float32, Header

from mtr_core import names
from mtr_core.lockstep import direct_publisher, run_node
from mtr_core.lockstep.clock import reading, steady_ns
from mtr_core.lockstep.patience import patience_at_least_s
from mtr_core.schedule import CLOCK_STEP, LIDAR, SIMULATION_START_NS, slot
from mtr_core.se2 import Pose2
from mtr_description.base_controller import CONTROLLER, base_controller_of
from mtr_description.robot_description import described_robot
from mtr_msgs.msg import ActiveFaults

from . import conversions
from .clock import connections
from .clock.barrier import SILENT_AFTER_WALL_S, Barrier, Watcher
from .clock.machine import MADE_UP_S, StampOffset, stamped, stood_offsets, take_precedence
from .clock.pacing import Pace
from .firmware.connections import emulated_firmware, firmware_topics
from .parameters import SimulatorParameters
from .physics.robot import robot_model
from .physics.wheels import BaseParameters, parameters_of
from .sensors.imu import ImuParameters
from .sensors.readings import Sensors
from .world import World

BATTERY = slot(1000)


def loaded_base() -> Optional[BaseParameters]:
    """Return the platform according to its controller's parameters, as on a real one; None without any."""
    where = f"/{CONTROLLER}"
    values = rospy.get_param(where, None)
    return None if values is None else parameters_of(base_controller_of(values, where))


class SimulatorNode:
    """Loop of the simulator: wait for the holds, execute the nodes' commands, step, publish."""

    def __init__(self, parameters: SimulatorParameters):
        firmware = emulated_firmware(parameters.firmware_elf) if parameters.firmware_elf else None
        self._world = World(parameters, firmware, robot_model(described_robot(), parameters.rear_lidar),
                            loaded_base())
        self._firmware = firmware_topics(self._world.firmware)
        self._output = Output(parameters.rear_lidar, self._firmware.publishers)
        self._barrier = Barrier(parameters.held_by, NodeWatcher(self._output), has_ended=self._has_ended,
                                silent_after_s=patience_at_least_s(SILENT_AFTER_WALL_S))
        self._holds: Optional[rospy.Subscriber] = None
        is_simulated = rospy.get_param("/use_sim_time", False)
        self._pace = Pace(parameters.real_time_factor, lambda: steady_ns() * 1e-9,
                          made_up_s=0.0 if is_simulated else MADE_UP_S)
        self._stamps = StampOffset(is_simulated, parameters.real_time_factor, lambda: self._pace.due_s, reading)
        self._is_simulated, self._told_lost_s = is_simulated, 0.0
        if not is_simulated and not take_precedence():
            rospy.logwarn("The simulator may not run before other programs: on a busy machine its world stands still "
                          "now and then, and the robot with it. Start it as a user who may set priorities.")
        self._stopped = threading.Event()
        self._received: Deque[Callable[[], None]] = collections.deque()
        self._contacts: Set[str] = set()
        rospy.on_shutdown(self.stop)

    def spin(self) -> None:
        """Simulate until shutdown."""
        try:
            self._run()
        finally:
            self._world.close()

    def _run(self) -> None:
        self._subscribe()
        self._barrier.wait_for_expected()
        connections.wait_until_complete(rosgraph.get_master_uri(), rospy.get_name(), self._stopped, rospy.logwarn)
        time_ns = SIMULATION_START_NS
        self._pace.start(time_ns * 1e-9)
        self._output.clock(time_ns, set())
        while self._barrier.wait(time_ns + CLOCK_STEP.period_ns):
            while self._received:
                self._received.popleft()()
            # All nodes wait here, so that the set of subscribers does not depend on the machine's speed.
            self._world.sim.scans_wanted = self._output.has_scan_listener()
            sensors = self._world.step()
            time_ns = sensors.time_ns
            lost_s = self._pace.lost_s
            delay_s = self._pace.delay(time_ns * 1e-9)
            if delay_s:
                self._stopped.wait(delay_s)
            self._publish(sensors, 0 if self._is_simulated else round((self._pace.lost_s - lost_s) * 1e9))
            self._firmware.publish(time_ns)
            self._output.clock(time_ns, self._barrier.asleep(time_ns))
            self._world.sim.cast_ahead()
            self._log(time_ns)
        rospy.loginfo("%s; %s.", self._pace.total(time_ns * 1e-9), self._barrier.longest_waits())

    def stop(self) -> None:
        """End the loop; rospy calls it on Ctrl-C."""
        self._stopped.set()
        self._barrier.stop()

    def _subscribe(self) -> None:
        sim, equipment = self._world.sim, self._world.equipment
        self._listen(names.WHEEL_COMMAND, Twist, lambda twist: sim.command(twist.linear.x, twist.angular.z))
        self._listen(names.SIM_HANDLE_REQUEST, Bool, lambda request: equipment.request_handle(locks=request.data))
        self._listen(names.SIM_IGNITION, Bool, lambda state: equipment.set_ignition(state.data))
        self._listen(names.SIM_CAR_SPEED, Float32, lambda speed: equipment.set_car_speed(speed.data))
        self._listen(names.SIM_KIDNAP, Pose2D, self._kidnap)
        self._listen(names.ACTIVE_FAULTS, ActiveFaults, self._set_faults)
        for topic, message_type, handle in self._firmware.subscriptions:
            self._listen(topic, message_type, handle)
        self._holds = rospy.Subscriber(names.SIM_HOLD, Header, self._hold, tcp_nodelay=True)

    def _listen(self, topic: str, message_type: Any, handle: Callable[[Any], None]) -> None:
        """Subscribe; each message is handled in the loop, before the step that follows its arrival."""
        def take(message: Any) -> None:
            self._received.append(lambda: handle(message))
            self._barrier.message(message._connection_header["callerid"])
        rospy.Subscriber(topic, message_type, take, tcp_nodelay=True)

    def _kidnap(self, there: Pose2D) -> None:
        if not all(map(math.isfinite, (there.x, there.y, there.theta))):
            rospy.logwarn("The robot was not carried away: %s is no pose in the Car's frame.", there)
            return
        self._world.kidnap(Pose2(there.x, there.y, there.theta))
        rospy.loginfo("The robot was carried to x %.2f m, y %.2f m, heading %.0f deg in the Car's frame.", there.x,
                      there.y, math.degrees(there.theta))

    def _set_faults(self, active: ActiveFaults) -> None:
        self._world.equipment.set_faults({fault.part: fault.kind for fault in active.faults})

    def _hold(self, message: Header) -> None:
        self._barrier.hold(message.frame_id, message.stamp.to_nsec(), message.seq)

    def _has_ended(self, node: str) -> bool:
        """Return True if the connection of the node's holds was closed."""
        connections_now = self._holds.impl.connections if self._holds else []
        return all((each.header or {}).get("callerid") != node for each in connections_now)

    def _publish(self, sensors: Sensors, lost_ns: int) -> None:
        """Publish the readings of a tick, and of the time that the loop has then lost."""
        offset_ns = self._stamps.at(sensors.time_ns)
        self._output.publish(sensors, self._world, offset_ns - lost_ns)
        self._world.firmware.stand(lost_ns)
        for stood_ns in stood_offsets(offset_ns, lost_ns):
            self._output.publish_motion(stamped(self._world.sim.stand(), stood_ns))

    def _log(self, time_ns: int) -> None:
        report = self._pace.report(time_ns * 1e-9)
        if report:
            rospy.loginfo("%s; %s.", report, self._barrier.longest_waits())
            self._tell_lost_time()
        if self._world.contacts != self._contacts:
            for name in sorted(self._world.contacts - self._contacts):
                rospy.logwarn("The robot touches %s at %.2f s.", name, time_ns * 1e-9)
            self._contacts = self._world.contacts

    def _tell_lost_time(self) -> None:
        lost_s, self._told_lost_s = self._pace.lost_s - self._told_lost_s, self._pace.lost_s
        if lost_s and not self._is_simulated:
            rospy.logwarn("The machine is too busy: the simulated world has stood still for %.2f s, and the robot with "
                          "it.", lost_s)


class Output:
    """Publishers, and their schedule.

    The loop sends without queues, so that all messages of a tick are sent before the clock.
    """

    def __init__(self, rear_lidar: bool, further: Iterable[Any] = ()):
        # Latched: a node that starts while simulated time waits must receive the time.
        self._clock = direct_publisher("/clock", Clock, latch=True)
        self._front = direct_publisher(names.FRONT_SCAN, conversions.NumpyScan)
        self._rear = direct_publisher(names.REAR_SCAN, conversions.NumpyScan) if rear_lidar else None
        self._imu = direct_publisher(names.IMU_DATA, Imu)
        self._odometry = direct_publisher(names.WHEEL_ODOMETRY, Odometry)
        self._battery = direct_publisher(names.BATTERY, BatteryState)
        self._truth = direct_publisher(names.SIM_TRUTH, Odometry)
        self._publishers = [*(each for each in vars(self).values() if each), *further]
        self._muted: List[Tuple[Any, Any]] = []
        self._imu_message = conversions.ImuMessage(ImuParameters())
        self._odometry_message = conversions.OdometryMessage(names.ODOM)
        self._truth_message = conversions.TruthMessage()

    def mute(self, node: str) -> None:
        """Stop sending to a node that does not read, because its full buffers would block the loop."""
        for topic in (publisher.impl for publisher in self._publishers):
            with topic.c_lock:
                silent = [each for each in topic.connections if each.endpoint_id == node]
                topic.connections = [each for each in topic.connections if each.endpoint_id != node]
            self._muted += [(topic, connection) for connection in silent]

    def unmute(self, node: str) -> None:
        """Resume sending to a node, unless it has reconnected."""
        for topic, connection in self._muted:
            with topic.c_lock:
                if connection.endpoint_id == node and all(each.endpoint_id != node for each in topic.connections):
                    topic.connections = [*topic.connections, connection]
            if topic is self._clock.impl:
                # Simulated time may wait for this node, which has missed the current time.
                self._tell_time(topic.latch, [connection])
        self._muted = [each for each in self._muted if each[1].endpoint_id != node]

    def has_scan_listener(self) -> bool:
        """Return True if a LiDAR has a subscriber."""
        return any(each.get_num_connections() for each in (self._front, self._rear) if each)

    def clock(self, time_ns: int, asleep: Set[str]) -> None:
        """Publish the time to all nodes except those that work later, because each message wakes a process."""
        self._tell_time(conversions.clock_message(time_ns),
                        (each for each in self._clock.impl.connections if each.endpoint_id not in asleep))

    def _tell_time(self, message: Clock, connections_to: Iterable[Any]) -> None:
        topic, data = self._clock.impl, conversions.serialized(message)
        # rospy sends the latched time to new subscribers under the same lock, so the time never decreases for a node.
        with topic.publock or contextlib.nullcontext():  # None as soon as rospy has closed the topic
            topic.latch = message
            for connection in list(connections_to):
                try:
                    connection.write_data(data)
                except (OSError, TransportException):
                    topic.remove_connection(connection)

    def publish(self, sensors: Sensors, world: World, offset_ns: int) -> None:
        """Publish all messages of a tick except the clock, which is last; offset_ns is added to the stamps."""
        due_ns, sensors = sensors.time_ns, stamped(sensors, offset_ns)
        for publisher, scan, frame in ((self._front, sensors.front_scan, names.FRONT_LIDAR),
                                       (self._rear, sensors.rear_scan, names.REAR_LIDAR)):
            if scan and publisher is not None and publisher.get_num_connections():
                publisher.publish(conversions.scan_message(scan, frame))
        if LIDAR.last_at(due_ns) == due_ns and self._truth.get_num_connections():
            self._truth.publish(self._truth_message.fill(world.truth, offset_ns))
        if BATTERY.last_at(due_ns) == due_ns:
            self._battery.publish(conversions.battery_message(sensors.time_ns, sensors.battery))
        self.publish_motion(sensors)

    def publish_motion(self, sensors: Sensors) -> None:
        """Publish the readings of IMU and wheels with their stamps."""
        self._imu.publish(self._imu_message.fill(sensors.time_ns, sensors.imu))
        self._odometry.publish(self._odometry_message.fill(sensors.time_ns, sensors.odometry))


class NodeWatcher(Watcher):
    """Logs events, and prevents the output from filling the buffers of a node that does not read."""

    def __init__(self, output: Output):
        self._output = output

    def warn(self, sentence: str) -> None:
        """Log a warning."""
        rospy.logwarn("%s", sentence)

    def dropped(self, name: str) -> None:
        """Stop sending to the node."""
        self._output.mute(name)

    def returned(self, name: str) -> None:
        """Resume sending to the node."""
        self._output.unmute(name)


def main() -> int:
    """Run the node; return its exit status."""
    # The node creates the time for which the others wait.
    return run_node("simulator", SimulatorParameters, SimulatorNode, disable_rostime=True)
