"""The test area that the robot does not leave: orders, their limits, and the one in force."""
# SPDX-License-Identifier: Apache-2.0
