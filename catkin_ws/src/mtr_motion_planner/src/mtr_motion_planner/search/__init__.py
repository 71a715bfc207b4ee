"""Choice of the quickest way to a goal."""
# SPDX-License-Identifier: Apache-2.0
