"""Hours of the robot's time with faults sprinkled in: does anything grow, does accuracy stay?"""
# SPDX-License-Identifier: Apache-2.0
