"""Campaigns of simulated tests: plans, kernels that simulate a test, and workers. Independent of the robot stack."""
# SPDX-License-Identifier: Apache-2.0
