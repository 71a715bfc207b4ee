"""Runs a campaign: workers, results, the store."""
# SPDX-License-Identifier: Apache-2.0
