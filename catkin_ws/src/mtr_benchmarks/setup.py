"""Python packages of mtr_benchmarks for catkin."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

PARTS = ("can_bus", "car_clearance", "faults", "gazebo", "gui", "harness", "kills", "lidar_course", "link", "liveness",
         "localization", "localization.drives", "localization.ends", "localization.judging", "localization.methods",
         "motion", "preflight", "ranges", "real", "real_time", "serial", "simulation", "soak", "truth")
PACKAGES = ["mtr_benchmarks", *(f"mtr_benchmarks.{part}" for part in PARTS)]

setup(**generate_distutils_setup(packages=PACKAGES, package_dir={"": "src"}))
