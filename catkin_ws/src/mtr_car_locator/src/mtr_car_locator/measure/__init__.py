"""Pose, size and outline of the found Car with their uncertainties."""
# SPDX-License-Identifier: Apache-2.0
