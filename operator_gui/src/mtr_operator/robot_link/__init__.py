"""The Operator's connection to the robot, and its substitutes."""
# SPDX-License-Identifier: Apache-2.0
