"""Comparison of the results with the Operator's limits: Pass, Inconclusive or Fail."""
# SPDX-License-Identifier: Apache-2.0
