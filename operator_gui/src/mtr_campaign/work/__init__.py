"""Execution of a campaign: workers, results, store."""
# SPDX-License-Identifier: Apache-2.0
