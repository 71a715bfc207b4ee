"""Python packages of mtr_fault_injection for catkin."""
# SPDX-License-Identifier: Apache-2.0
from distutils.core import setup

from catkin_pkg.python_setup import generate_distutils_setup

setup(**generate_distutils_setup(packages=["mtr_fault_injection", "mtr_fault_injection.link"],
                                 package_data={"mtr_fault_injection": ["set_clock.c"]}, package_dir={"": "src"}))
