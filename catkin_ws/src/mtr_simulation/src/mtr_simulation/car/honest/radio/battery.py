"""The key's battery: less voltage is less power, and below a limit there is silence.

    gain_dB = 20 log10(U / U_nominal)

The output stage's power goes with the square of its voltage. A CR2032 has 3.0 V when new, 2.5 V for most of its second
half, and the key's processor stops at 1.8 to 2.2 V (data sheets of such cells and of 434 MHz transmitters).
"""
# SPDX-License-Identifier: Apache-2.0
import math

NOMINAL_V = 3.0


def battery_gain_db(voltage_v: float, silent_below_v: float) -> float:
    """Gain over a new battery; minus infinity when the key is silent."""
    return -math.inf if voltage_v < silent_below_v else 20.0 * math.log10(voltage_v / NOMINAL_V)
