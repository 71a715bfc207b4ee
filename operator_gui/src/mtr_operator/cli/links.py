"""Links according to the command line; a driver is imported only when it is used."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse

from mtr_operator.domain.distance_feed import DistanceFeed
from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.ports import CarLink, RobotLink
from mtr_operator.station.connection import LinkOpener, RobotChoice


def robot_link(options: argparse.Namespace, is_real_time: bool = False) -> RobotLink:
    """Return the link to the robot or its substitute, not connected yet. is_real_time: of the substitute, otherwise as
    fast as possible. With a real bus it is required, because the frames are placed on the robot's clock."""
    if options.simulated_robot:
        from mtr_operator.robot_link.fake import FakeRobotLink
        from mtr_operator.robot_link.virtual.robot import VirtualRobot
        # The same seed gives the same record; a resumed test has already used the robot of its seed.
        is_begun = getattr(options, "continued", None) is None
        start = VirtualRobot if is_begun else VirtualRobot.started
        return FakeRobotLink(time_factor=float(is_real_time), robot=start(options.seed))
    return LinkOpener().robot(RobotChoice(options.robot, options.subscriber_port, options.publisher_port,
                                          bool(options.unencrypted)))


def car_link(options: argparse.Namespace) -> CarLink:
    """Return the link to the Car or its substitute, not connected yet."""
    if options.simulated_car:
        from mtr_operator.car_link.simulated_car import SimulatedCarLink
        return SimulatedCarLink(options.seed, options.simulated_key_sleep, options.simulated_extender,
                                car_seed=options.car_seed)
    if options.can_log is not None:
        from mtr_operator.car_link.log.log_car import LogCarLink
        return LogCarLink(options.can_log, options.car_profile)
    from mtr_operator.car_link.adapter import AdapterSettings
    from mtr_operator.car_link.bus import CanCarLink
    further = {name: AdapterSettings(interface, channel, bitrate_bps, is_listening=True,
                                     data_bitrate_bps=options.can_data_bitrate)
               for name, interface, channel, bitrate_bps in map(_further_bus, options.can_bus)}
    return CanCarLink(options.can_interface, options.can_channel, options.can_bitrate, options.car_profile,
                      is_listening=not options.can_normal, data_bitrate=options.can_data_bitrate,
                      further=further)


def lives_in_real_time(options: argparse.Namespace) -> bool:
    """Return True for a bus or feed outside the application, which requires a robot's substitute in real time."""
    is_feed_outside = options.phone_feed is not None and not options.phone_feed.startswith("simulated")
    return is_feed_outside or (not options.simulated_car and options.can_log is None)


def phone_feed(options: argparse.Namespace) -> DistanceFeed | None:
    """Return the feed of a phone's distance, not connected yet; None for the Car's own. InvalidParameter states the
    allowed values."""
    if options.phone_feed is None:
        return None
    from mtr_operator.car_link.phone.address import feed_address, feed_at
    return feed_at(feed_address(options.phone_feed), options.seed)


def _further_bus(text: str) -> tuple[str, str, str, int]:
    """Return name, interface, channel and bit/s; a channel may itself contain a colon."""
    name, _, adapter = text.partition("=")
    interface, _, place = adapter.partition(":")
    channel, _, bitrate = place.rpartition(":")
    if not (name and interface and channel and bitrate.isdecimal()):
        raise InvalidParameter(f"--can-bus is {text!r}; allowed is NAME=INTERFACE:CHANNEL:BITRATE, such as "
                               "body=socketcan:can1:125000.")
    return name, interface, channel, int(bitrate)
