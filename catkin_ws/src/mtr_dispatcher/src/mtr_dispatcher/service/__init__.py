"""Service mode: wheels, lift and servos remain disabled while people work on the robot."""
# SPDX-License-Identifier: Apache-2.0
