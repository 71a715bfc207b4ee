"""Buses of a log by the numbers of its channels."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..further.entries import FIRST_BUS
from ..profile import CarProfile
from .text.lines import LoggedFrame

# Name of channels that the profile does not name, but that also carry the message of the state.
OTHER_CHANNEL = "channel {}"


class LogBuses:
    """Assignment of channels to buses. profile: names the further buses, in the order of the channels from 1."""

    def __init__(self, profile: CarProfile):
        self._profile = profile
        self._state_channel: int | None = 0 if profile.further.buses else None

    def bus_of(self, frame: LoggedFrame) -> str:
        """Return the name of a frame's bus. A channel that the profile does not name belongs to the bus of the state,
        except a second channel with the state's message."""
        names, channel = self._profile.further.buses, frame.channel
        if 0 < channel <= len(names):
            return names[channel - 1]
        if not self._profile.is_message(frame.can_id, frame.is_extended):
            return FIRST_BUS
        if self._state_channel is None:
            self._state_channel = channel
        return FIRST_BUS if channel == self._state_channel else OTHER_CHANNEL.format(channel)
