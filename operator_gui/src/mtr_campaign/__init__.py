"""Campaigns of simulated tests: plans, kernels that run a test, and a crew of workers. Works without the others."""
# SPDX-License-Identifier: Apache-2.0
