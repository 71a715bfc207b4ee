"""Kills nodes of the robot at random instants of complete tests, and checks for lost, duplicate and wrong results."""
# SPDX-License-Identifier: Apache-2.0
