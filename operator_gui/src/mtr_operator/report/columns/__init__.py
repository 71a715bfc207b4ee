"""Columns of results.csv that are not stored by a scenario."""
# SPDX-License-Identifier: Apache-2.0
