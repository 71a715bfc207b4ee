"""Motions as functions of time, within the limits of speed, acceleration and jerk."""
# SPDX-License-Identifier: Apache-2.0
