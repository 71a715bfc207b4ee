"""ROS node with simulated firmware and Car for an external physics simulator, which provides the key pose."""
# SPDX-License-Identifier: Apache-2.0
import threading
from typing import Any

import rospy
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Bool, Float32, Float64

from mtr_core import names
from mtr_core.lockstep import direct_publisher, run_node
from mtr_core.schedule import SIMULATION_START_NS, slot
from mtr_core.se2 import heading_of
from mtr_msgs.msg import ActiveFaults
from mtr_simulation.conversions import battery_message
from mtr_simulation.equipment import Equipment
from mtr_simulation.firmware.connections import SimulatedTopics
from mtr_simulation.parameters import EquipmentParameters
from mtr_simulation.sensors.battery import battery

from .ticks import ticks_between

BATTERY = slot(1000)


class EquipmentNode:
    """Each key pose is a 20 ms tick of firmware and Car; missing poses are filled in."""

    def __init__(self, parameters: EquipmentParameters):
        self._equipment = Equipment(parameters)
        self._topics = SimulatedTopics(self._equipment.firmware)
        self._lift = direct_publisher(names.SIM_LIFT, Float64)
        self._battery = direct_publisher(names.BATTERY, BatteryState)
        # Each topic has its own thread, so access to the firmware is locked.
        self._lock = threading.Lock()
        for topic, message_type, handle in self._topics.subscriptions:
            self._listen(topic, message_type, handle)
        self._listen(names.SIM_HANDLE_REQUEST, Bool, lambda request: self._equipment.request_handle(request.data))
        self._listen(names.SIM_IGNITION, Bool, lambda state: self._equipment.set_ignition(state.data))
        self._listen(names.SIM_CAR_SPEED, Float32, lambda speed: self._equipment.set_car_speed(speed.data))
        self._listen(names.ACTIVE_FAULTS, ActiveFaults, lambda active: self._equipment.set_faults(
            {fault.part: fault.kind for fault in active.faults}))
        self._listen(names.SIM_KEY, PoseStamped, self._see)

    def spin(self) -> None:
        """Wait for messages until shutdown."""
        try:
            rospy.spin()
        finally:
            with self._lock:
                self._equipment.close()

    def _listen(self, topic: str, message_type: Any, handle: Any) -> None:
        def take(message: Any) -> None:
            with self._lock:
                if not rospy.is_shutdown():
                    handle(message)
        rospy.Subscriber(topic, message_type, take, tcp_nodelay=True)

    def _see(self, key: PoseStamped) -> None:
        for time_ns in ticks_between(self._equipment.time_ns, key.header.stamp.to_nsec()):
            self._equipment.begin_step()
            self._equipment.step()
            place, turn = key.pose.position, key.pose.orientation
            self._equipment.see((place.x, place.y, place.z), heading_of(turn.z, turn.w))
            self._topics.publish(time_ns)
            if BATTERY.last_at(time_ns) == time_ns:
                elapsed_s = (time_ns - SIMULATION_START_NS) * 1e-9
                self._battery.publish(battery_message(time_ns, battery(elapsed_s)))
        self._lift.publish(Float64(self._equipment.firmware.lift_height_m))


def main() -> int:
    """Run the node and return its exit status."""
    return run_node("equipment", EquipmentParameters, EquipmentNode)
