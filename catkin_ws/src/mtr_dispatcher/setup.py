"""Declares the Python packages of mtr_dispatcher for catkin."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(**generate_distutils_setup(
    packages=["mtr_dispatcher", "mtr_dispatcher.access", "mtr_dispatcher.area", "mtr_dispatcher.disks",
              "mtr_dispatcher.service", "mtr_dispatcher.status"],
    package_dir={"": "src"}))
