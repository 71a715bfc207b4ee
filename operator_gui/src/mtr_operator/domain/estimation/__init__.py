"""Estimates from measurements of a Car: distances with intervals that hold when the test is repeated. Pure numpy."""
# SPDX-License-Identifier: Apache-2.0
