"""Radio between the Remote key and the Car: low-frequency field of the passive entry and UHF link of the buttons."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Tuple

from .noise import ShadowField, gaussian
from .parameters import LfAntenna, PassiveEntryParameters, RemoteParameters

Point = Tuple[float, float, float]

# Smallest distance: the dipole formula is invalid below it, and the strength exceeds every threshold.
_NEAREST_M = 0.2


class PassiveEntryRadio:
    """Strength of the low-frequency field at the key, as the key measures and returns it at each poll."""

    def __init__(self, seed: int, parameters: PassiveEntryParameters, correlation_m: float):
        self._seed = seed
        self._noise_sigma_db = parameters.noise_sigma_db
        self._paths = [
            (antenna, ShadowField(seed, antenna.name, parameters.shadow_sigma_db, correlation_m))
            for antenna in parameters.antennas
        ]

    def strength_db(self, key: Point) -> float:
        """Return the strength of the strongest antenna at a place, without the noise in time."""
        return max(_dipole_db(antenna, key) + shadow.at(*key) for antenna, shadow in self._paths)

    def poll_db(self, key: Point, poll: int) -> float:
        """Return the measured strength of a poll by its number."""
        return self.strength_db(key) + self._noise_sigma_db * gaussian(self._seed, "poll", poll)


def _dipole_db(antenna: LfAntenna, key: Point) -> float:
    """Return the near field of a magnetic dipole: cubic decay, twice as strong along the rod as at its side."""
    dx, dy, dz = key[0] - antenna.x_m, key[1] - antenna.y_m, key[2] - antenna.z_m
    distance = max(math.sqrt(dx * dx + dy * dy + dz * dz), _NEAREST_M)
    along = (dx * math.cos(antenna.axis_rad) + dy * math.sin(antenna.axis_rad)) / distance
    pattern_db = 10.0 * math.log10(1.0 + 3.0 * along * along)
    lobe_db = antenna.lobe_db * math.cos(math.atan2(dy, dx) - antenna.lobe_rad)
    return antenna.strength_db + pattern_db + lobe_db - 60.0 * math.log10(distance)


class RemoteRadio:
    """Link budget from the key's transmitter to the Receiver in the cabin."""

    def __init__(self, seed: int, parameters: RemoteParameters, correlation_m: float):
        self._seed = seed
        self._parameters = parameters
        self._shadow = ShadowField(seed, "remote", parameters.shadow_sigma_db, correlation_m)

    def margin_db(self, key: Point) -> float:
        """Return the received power above the Receiver's threshold, without the noise in time."""
        p = self._parameters
        dx, dy, dz = (a - b for a, b in zip(key, p.receiver_xyz_m))
        distance = max(math.sqrt(dx * dx + dy * dy + dz * dz), _NEAREST_M)
        azimuth = math.atan2(dy, dx)
        pattern_db = sum(lobe.gain_db * math.cos(lobe.order * (azimuth - lobe.direction_rad)) for lobe in p.lobes)
        height_db = 3.0 * ((key[2] - p.best_height_m) / p.height_3db_m) ** 2
        path_db = 10.0 * p.path_loss_exponent * math.log10(distance)
        gains_db = p.margin_at_1m_db + pattern_db + self._shadow.at(*key)
        return gains_db - path_db - min(height_db, p.height_loss_limit_db)

    def is_received(self, key: Point, transmission: int) -> bool:
        """Return True if the transmission with this number is received."""
        noise_db = self._parameters.noise_sigma_db * gaussian(self._seed, "transmission", transmission)
        return self.margin_db(key) + noise_db >= 0.0
