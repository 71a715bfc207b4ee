"""Parameters of the simulated Car's radio and ECU: antennas, thresholds and times.

Positions are in the true Car frame (origin on the ground below the Car's centre, x to its front, y to its left, z up).
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import ClassVar, Tuple

from mtr_core.errors import ConfigurationError, check_range
from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class LfAntenna:
    """One low-frequency antenna of the passive entry: a ferrite rod, which is a magnetic dipole."""

    name: str
    x_m: float
    y_m: float
    z_m: float
    axis_rad: float  # direction of the rod in the ground plane
    strength_db: float  # field 1 m from the rod's side, above the key's reference
    lobe_db: float  # the bodywork adds lobe_db towards lobe_rad and subtracts it in the opposite direction
    lobe_rad: float

    def __post_init__(self) -> None:
        check_range(f"antenna {self.name}.strength_db", self.strength_db, -40.0, 40.0, "dB")
        check_range(f"antenna {self.name}.lobe_db", self.lobe_db, 0.0, 10.0, "dB")


@dataclass(frozen=True)
class Lobe:
    """One cosine of an antenna pattern: gain_db * cos(order * (azimuth - direction_rad))."""

    order: int
    gain_db: float
    direction_rad: float


# Places on a car of 4.5 m x 1.8 m; ranges of a mid-size car, about 1.5 m for unlocking, deliberately different per
# side.
DEFAULT_ANTENNAS = (
    LfAntenna("left_door", 0.05, 0.88, 0.75, 0.0, 11.2, 1.0, math.radians(100.0)),
    LfAntenna("right_door", 0.05, -0.88, 0.75, 0.0, 10.6, 1.2, math.radians(-60.0)),
    LfAntenna("boot", -2.15, 0.0, 0.60, math.radians(90.0), 11.8, 1.0, math.radians(150.0)),
    LfAntenna("front", 2.10, 0.0, 0.55, math.radians(90.0), 11.6, 0.8, math.radians(-20.0)),
)
# Windscreen and rear window attenuate less than the doors with their pillars; the other lobes are asymmetries.
DEFAULT_REMOTE_LOBES = (
    Lobe(1, 0.6, math.radians(30.0)),
    Lobe(2, 2.6, 0.0),
    Lobe(3, 1.0, math.radians(75.0)),
    Lobe(5, 0.6, math.radians(20.0)),
)


@dataclass(frozen=True)
class PassiveEntryParameters(ParameterSet):
    """Passive entry, which reacts to the key's vicinity."""

    PREFIX: ClassVar[str] = "passive_entry."

    enabled: bool = True
    antennas: Tuple[LfAntenna, ...] = DEFAULT_ANTENNAS
    unlock_threshold_db: float = 0.0
    lock_threshold_db: float = -12.0
    poll_period_ms: int = number(100, 20, 1000, "ms")
    debounce_polls: int = number(2, 1, 10, "polls")
    shadow_sigma_db: float = number(1.0, 0.0, 10.0, "dB")
    noise_sigma_db: float = number(0.2, 0.0, 10.0, "dB")

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.antennas:
            raise ConfigurationError("Parameter passive_entry.antennas is empty; allowed is one or more.")
        check_range("passive_entry.lock_threshold_db", self.lock_threshold_db, -60.0, self.unlock_threshold_db, "dB")


@dataclass(frozen=True)
class RemoteParameters(ParameterSet):
    """Button of the Remote key: UHF link from the key to the Receiver, and the contact below the button."""

    PREFIX: ClassVar[str] = "remote."

    receiver_xyz_m: Tuple[float, float, float] = (-0.20, 0.10, 1.15)
    margin_at_1m_db: float = number(24.8, -20.0, 80.0, "dB")
    # Two rays, direct and from the ground, beyond their break point.
    path_loss_exponent: float = number(4.0, 1.5, 6.0, "(exponent)")
    lobes: Tuple[Lobe, ...] = DEFAULT_REMOTE_LOBES
    best_height_m: float = 1.0
    height_3db_m: float = number(0.4, 0.05, 10.0, "m")  # 3 dB less at this distance above or below the best height
    height_loss_limit_db: float = 12.0
    shadow_sigma_db: float = number(0.7, 0.0, 10.0, "dB")
    noise_sigma_db: float = number(0.2, 0.0, 10.0, "dB")
    contact_travel: float = number(0.6, 0.0, 1.0, "of the servo's full travel")
    contact_ms: int = number(80, 0, 2000, "ms")  # a shorter contact counts as bouncing


@dataclass(frozen=True)
class CarParameters(ParameterSet):
    """Radio and ECU of the whole Car."""

    PREFIX: ClassVar[str] = "car."

    boot_ms: int = number(200, 0, 10_000, "ms")  # until then the ECU reports its locks as unknown
    shadow_correlation_m: float = number(0.5, 0.05, 10.0, "m")
    passive_entry: PassiveEntryParameters = PassiveEntryParameters()
    remote: RemoteParameters = RemoteParameters()
