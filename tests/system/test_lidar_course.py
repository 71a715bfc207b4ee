"""A short form of `make bench-lidar`: wall and pole ahead, and a LiDAR that shows nothing."""
# SPDX-License-Identifier: Apache-2.0
import json
import subprocess
import sys

# A start, a map of the Car and two drives take 60 s on a machine of their own.
LIMIT_S = 400.0


def test_robot_with_a_lidar_that_shows_nothing_touches_neither_wall_nor_pole(out):
    done = subprocess.run([sys.executable, "-m", "mtr_benchmarks.lidar_course", "--short", "--out", str(out)],
                          text=True, capture_output=True, timeout=LIMIT_S, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads((out / "lidar_course.json").read_text(encoding="utf-8"))
    assert len(found["trials"]) == 2 and all(each["clearance_m"] > 0.0 for each in found["trials"])
    assert all("sees nothing" in " ".join(each["messages"]) for each in found["trials"])
