"""Nodes of the robot are killed at random instants of whole tests: is anything lost, doubled or wrong?"""
# SPDX-License-Identifier: Apache-2.0
