"""Declares the Python packages of mtr_jackal for catkin."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(**generate_distutils_setup(packages=["mtr_jackal"], package_dir={"": "src"}))
