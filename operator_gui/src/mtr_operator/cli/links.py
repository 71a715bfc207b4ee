"""The links that the command line asks for; a driver is imported only when it is used."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse

from mtr_operator.domain.ports import CarLink, RobotLink
from mtr_operator.station.connection import LinkOpener, RobotChoice


def robot_link(options: argparse.Namespace) -> RobotLink:
    """Link to the robot or its substitute, not connected yet."""
    if options.simulated_robot:
        from mtr_operator.robot_link.fake import FakeRobotLink
        return FakeRobotLink(options.seed)
    return LinkOpener().robot(RobotChoice(options.robot, options.subscriber_port, options.publisher_port,
                                          bool(options.unencrypted)))


def car_link(options: argparse.Namespace) -> CarLink:
    """Link to the Car or its substitute, not connected yet."""
    if options.simulated_car:
        from mtr_operator.car_link.simulated_car import SimulatedCarLink
        return SimulatedCarLink(options.seed)
    if options.can_log is not None:
        from mtr_operator.car_link.log.log_car import LogCarLink
        return LogCarLink(options.can_log, options.car_profile)
    from mtr_operator.car_link.bus import CanCarLink
    return CanCarLink(options.can_interface, options.can_channel, options.can_bitrate, options.car_profile,
                      is_listening=not options.can_normal, data_bitrate=options.can_data_bitrate)
