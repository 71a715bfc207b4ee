"""Consistency checks between the inputs of another robot's bag during its conversion."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, List, Optional, Sequence

from .delays import Delays
from .echoes import EchoCount, check_echoes
from .errors import BagUnusable
from .imu_check import ImuCheck
from .motion import Sample, Sweep
from .sources import Asked
from .turn_lag import Lag, Rates, ScanTurns, rates_of, turn_lag

# Delays by drivers and networks are smaller; the robot's turns are the better reference.
MAX_DELAY_S = 1.0
# Largest difference of the stamp offsets of two LiDARs that one value can correct.
SAME_LAG_S = 0.3


class OdometryClock:
    """Turn rates and delays of the odometry, as the reference of the other inputs.

    Attributes:
        name: topic, or a phrase for transforms.
        turns: turn rates.
        delays: from the stamps to the recording.
    """

    def __init__(self, name: str, samples: Sequence[Sample], delays: Delays) -> None:
        self.name, self.delays = name, delays
        self.turns: Rates = rates_of([(sample.time_s, sample.angular_radps) for sample in samples])


class ScanCheck:
    """Echoes and stamps of one scan topic.

    Attributes:
        echoes: counts of scans.
    """

    def __init__(self, topic: str, sense: float) -> None:
        """Create a check. sense: -1 for a LiDAR that is mounted upside down."""
        self.topic, self.echoes = topic, EchoCount(topic)
        self._turns, self._delays = ScanTurns(sense), Delays()

    def add(self, scan: Sweep, received_s: float) -> None:
        """Add a scan with its corrected stamp."""
        self.echoes.add(scan)
        self._turns.add(scan)
        self._delays.add(received_s, scan.stamp_s)

    def turn_lag(self, odometry: OdometryClock) -> Optional[Lag]:
        """Return the lag behind the odometry from the turns of the robot."""
        return turn_lag(odometry.turns, self._turns.rates)

    def recorded_lag_s(self, odometry: OdometryClock) -> Optional[float]:
        """Return the lag behind the odometry from the recording times."""
        ours, theirs = self._delays.median_s, odometry.delays.median_s
        return None if ours is None or theirs is None else theirs - ours


def check_odometry(scans: Sequence[ScanCheck], imu: ImuCheck, odometry: OdometryClock) -> None:
    """Raise BagUnusable if scans and IMU agree on the turns, but the odometry has them at another time."""
    found = [turn_lag(odometry.turns, imu.rates), *(scan.turn_lag(odometry) for scan in scans)]
    lags_s = [lag.lag_s for lag in found if lag is not None and lag.is_certain]
    if len(lags_s) == len(found) and max(lags_s) - min(lags_s) <= SAME_LAG_S:
        side = "early" if lags_s[0] > 0.0 else "late"
        raise BagUnusable(f"The stamps of {odometry.name} are {abs(lags_s[0]):.2f} s {side} compared with the turns of "
                          "scans and IMU: correct the odometry's clock.")


def check_scans(scans: Sequence[ScanCheck], odometry: OdometryClock, asked: Asked) -> List[str]:
    """Return sentences about unusable scans; BagUnusable if they do not allow a reliable pose."""
    faults = check_echoes([scan.echoes for scan in scans])
    lags: Dict[str, float] = {}
    for scan in scans:
        found = scan.turn_lag(odometry)
        if found is not None and (found.is_certain or abs(found.lag_s) < SAME_LAG_S):
            lags[scan.topic] = found.lag_s if found.is_certain else 0.0
    reason = "as the turns of the robot show"
    if not lags and asked.scan_delay_s is None:
        reason = "by the times of recording"
        recorded = {scan.topic: scan.recorded_lag_s(odometry) for scan in scans}
        lags = {topic: lag_s for topic, lag_s in recorded.items() if lag_s is not None}
        lags = lags if any(abs(lag_s) > MAX_DELAY_S for lag_s in lags.values()) else {}
    _check_lags(lags, odometry.name, reason, asked.scan_delay_s or 0.0)
    return faults


def _check_lags(lags: Dict[str, float], odometry: str, reason: str, given_s: float) -> None:
    """Raise BagUnusable for an offset of scans. lags: topic -> lag in s; given_s: correction already applied."""
    if not any(lags.values()):
        return
    topic = max(lags, key=lambda each: abs(lags[each]))
    lag_s = lags[topic]
    if max(lags.values()) - min(lags.values()) > SAME_LAG_S:
        best = min(lags, key=lambda each: abs(lags[each]))
        remedy = f"replay with --front-scan {best} alone"
    else:
        remedy = f"replay with --scan-delay {given_s + lag_s:.2f}"
    side = "late" if lag_s > 0.0 else "early"
    raise BagUnusable(f"The stamps of {topic} are {abs(lag_s):.2f} s {side} compared with {odometry}, {reason}: "
                      f"{remedy}.")
