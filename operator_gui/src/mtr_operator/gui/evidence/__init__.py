"""Bundles of evidence in the window: written and verified in threads."""
# SPDX-License-Identifier: Apache-2.0
