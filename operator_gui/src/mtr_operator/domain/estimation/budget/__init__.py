"""Uncertainty budgets of measured distances, by the Guide to the expression of uncertainty in measurement (GUM)."""
# SPDX-License-Identifier: Apache-2.0
