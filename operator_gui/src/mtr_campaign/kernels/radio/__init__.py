"""Kernel with the application's scenarios on the radio model of the simulated Car only."""
# SPDX-License-Identifier: Apache-2.0
