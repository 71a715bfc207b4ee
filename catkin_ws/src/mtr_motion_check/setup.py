"""Declares the Python packages of mtr_motion_check for catkin."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(**generate_distutils_setup(packages=["mtr_motion_check"], package_dir={"": "src"}))
