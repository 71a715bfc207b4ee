"""What the robot sees around the Car: for the picture, and for a look at the plan before a test."""
# SPDX-License-Identifier: Apache-2.0
