"""Accuracy of the ranges of both scenarios on Cars with fading, random misses and polling, against their
requirements."""
# SPDX-License-Identifier: Apache-2.0
