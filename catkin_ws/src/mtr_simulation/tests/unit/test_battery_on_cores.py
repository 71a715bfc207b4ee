"""Charge of the simulated robot while it drives: what its own software does at each level."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import pytest

from mtr_core.liveness import NS
from mtr_core.schedule import SIMULATION_START_NS
from mtr_proto import robot_link_pb2 as link
from mtr_simulation import sim
from mtr_simulation.car.can_port import MemoryCanPort
from mtr_simulation.cores import robot as cores_robot
from mtr_simulation.cores.parameters import simulated_robot
from mtr_simulation.cores.robot import CoresOptions, CoresRobot
from mtr_simulation.sensors.readings import BatteryReading

BEGINS_AT_S = SIMULATION_START_NS * NS
FALLS_AT_S = 6.0
ENDS_AT_S = 20.0
# Statuses of the start.
STARTED_AFTER = 40
STANDING_MPS = 0.02


@pytest.fixture
def driven(monkeypatch):
    """driven(charge): Statuses of a robot that maps the Car, whose battery falls to the charge at FALLS_AT_S."""
    attended = dataclasses.replace(
        simulated_robot(), state_machine=dataclasses.replace(simulated_robot().state_machine, resume_by_operator=True))
    monkeypatch.setattr(cores_robot, "simulated_robot", lambda: attended)

    def drive(charge):
        monkeypatch.setattr(sim, "battery", lambda elapsed_s: BatteryReading(
            0.9 if elapsed_s < FALLS_AT_S else charge, 25.0, -3.0))
        robot, statuses, released = CoresRobot(CoresOptions(seed=3), MemoryCanPort()), [], 0
        for number in range(1, round(ENDS_AT_S / 0.1)):
            status = link.Status.FromString(robot.next_status())
            statuses.append(status)
            # The hold of the start ends by the Operator; later ones stay.
            released = status.hold_id if status.hold_id and number < STARTED_AFTER else released
            command = link.Command(session_id=5, id=number, seen_status_id=status.id, max_speed_mps=0.4, map_car_id=1,
                                   seen_robot_time_s=status.sent_time_s, resume_hold_id=released)
            robot.take(command.SerializeToString())
        robot.close()
        return statuses[STARTED_AFTER:]
    return drive


def codes(status):
    return {each.code for each in status.notifications}


@pytest.mark.parametrize(("charge", "percent", "is_low"), [(0.2, 20, False), (0.09, 9, True)])
def test_robot_goes_on_above_its_last_level_and_tells_that_it_is_low(driven, charge, percent, is_low):
    statuses = driven(charge)
    assert statuses[-1].state.battery_level == percent
    assert ("low_battery" in codes(statuses[-1])) is is_low
    assert not any(status.hold_id for status in statuses)
    assert max(abs(status.state.speed) for status in statuses[-20:]) > STANDING_MPS


def test_robot_whose_battery_is_empty_stops_and_is_on_hold(driven):
    statuses = driven(0.04)
    moving = [status for status in statuses if abs(status.state.speed) > STANDING_MPS]
    held = [status for status in statuses if status.hold_id]
    assert moving and held
    assert FALLS_AT_S + 9.0 < held[0].sent_time_s - BEGINS_AT_S < FALLS_AT_S + 13.0
    assert moving[-1].sent_time_s - held[0].sent_time_s < 1.5
    assert held == statuses[-len(held):] and len({status.hold_id for status in held}) == 1


def test_robot_whose_charge_is_unknown_says_no_charge_and_goes_on(driven):
    statuses = driven(math.nan)
    assert statuses[0].state.battery_level == 90
    assert not statuses[-1].state.HasField("battery_level") and not any(status.hold_id for status in statuses)
