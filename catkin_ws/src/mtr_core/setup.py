"""Declares the Python packages of mtr_core for catkin."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(**generate_distutils_setup(packages=["mtr_core", "mtr_core.bags", "mtr_core.executors", "mtr_core.lockstep"],
                                 package_dir={"": "src"}))
