"""The guided calibration: each step as a card, kept in the record of the robot."""
# SPDX-License-Identifier: Apache-2.0
