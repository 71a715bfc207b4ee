"""Mass and centre of mass of the robot by scales and tilt, for the limits of drive control."""
# SPDX-License-Identifier: Apache-2.0
