"""The simulated robot in one process without ROS: cores, simulator and Car, tick by tick as in lock-step."""
# SPDX-License-Identifier: Apache-2.0
