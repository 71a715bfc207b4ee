"""Catkin reads the Python packages of mtr_motion_planner from here."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(**generate_distutils_setup(packages=["mtr_motion_planner"], package_dir={"": "src"}))
