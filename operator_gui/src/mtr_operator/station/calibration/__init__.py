"""Guided calibration without its window."""
# SPDX-License-Identifier: Apache-2.0
