"""The simulated robot, its world and the Car, with a core that knows no ROS."""
# SPDX-License-Identifier: Apache-2.0
