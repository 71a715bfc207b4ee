"""Surroundings of the robot: the Car's body, poles, walls, people, and the test sites composed of them."""
# SPDX-License-Identifier: Apache-2.0
