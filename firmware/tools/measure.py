"""Measures the emulator: speed in lock-step, and load in real time; prints a table.

Usage: measure.py [SECONDS]
"""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import resource
import sys
import time
from typing import Tuple

FIRMWARE = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(FIRMWARE / "emulator" / "python"), str(FIRMWARE / "tests" / "emulated")]

from serial_host import NEGOTIATE, Host, frame  # noqa: E402

from mtr_emulator.emulator import MCUS, Emulator  # noqa: E402

STEP_US = 20_000
TICKS_PER_S = os.sysconf("SC_CLK_TCK")


def cpu_s(board: Emulator) -> float:
    """Processor time of the emulator so far."""
    fields = pathlib.Path(f"/proc/{board.pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICKS_PER_S


def lock_step(mcu: str, seconds: float, height_m: float) -> Tuple[float, float]:
    """Simulated seconds per second of the emulator's and of all processor time, with a talking host."""
    with Emulator(mcu, stepped=True) as board:
        host = Host(board)
        host.send(frame(NEGOTIATE))
        own_s = sum(resource.getrusage(resource.RUSAGE_SELF)[:2])
        elapsed_s = 0.0
        while elapsed_s < seconds:
            # To and fro, so that the motor runs all the time.
            host.height_m = height_m if elapsed_s % 10.0 < 5.0 else 0.0
            host.run(0.5, step_us=STEP_US)
            elapsed_s += 0.5
        emulator_s = cpu_s(board)
        host.close()
        return seconds / emulator_s, seconds / (emulator_s + sum(resource.getrusage(resource.RUSAGE_SELF)[:2]) - own_s)


def real_time(mcu: str, seconds: float) -> Tuple[float, float, float]:
    """Load of one core, simulated seconds per second, worst lag in s."""
    with Emulator(mcu) as board:
        started_s, cpu_started_s, time_us = time.monotonic(), cpu_s(board), board.probe().time_us
        time.sleep(seconds)
        seen = board.probe()
        passed_s = time.monotonic() - started_s
        return (cpu_s(board) - cpu_started_s) / passed_s, (seen.time_us - time_us) / 1e6 / passed_s, seen.worst_lag_s


def main() -> int:
    """Measure both boards."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 60.0
    for mcu in MCUS:
        for name, height_m in (("lift still", 0.0), ("lift moving", 1.0)):
            emulator, everything = lock_step(mcu, seconds, height_m)
            print(f"{mcu} lock-step, {name}: {emulator:.0f} x real time, with the host {everything:.0f} x")
        load, factor, lag_s = real_time(mcu, seconds / 4)
        print(f"{mcu} real time: {100 * load:.1f} % of a core, {factor:.3f} x, worst lag {1000 * lag_s:.1f} ms")
    return 0


if __name__ == "__main__":
    sys.exit(main())
