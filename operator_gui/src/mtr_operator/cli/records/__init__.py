"""The commands that compute recorded tests anew, and prove what was recorded."""
# SPDX-License-Identifier: Apache-2.0
