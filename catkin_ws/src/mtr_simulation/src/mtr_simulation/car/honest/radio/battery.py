"""Battery of the key: a lower voltage gives less power, and below a limit the key is silent.

    gain_dB = 20 log10(U / U_nominal)

The power of the output stage is proportional to the square of its voltage. A CR2032 has 3.0 V when new, and 2.5 V for
most of its second half. The key's processor stops at 1.8 to 2.2 V (data sheets of such cells and of 434 MHz
transmitters).
"""
# SPDX-License-Identifier: Apache-2.0
import math

NOMINAL_V = 3.0


def battery_gain_db(voltage_v: float, silent_below_v: float) -> float:
    """Return the gain relative to a new battery; minus infinity if the key is silent."""
    return -math.inf if voltage_v < silent_below_v else 20.0 * math.log10(voltage_v / NOMINAL_V)
