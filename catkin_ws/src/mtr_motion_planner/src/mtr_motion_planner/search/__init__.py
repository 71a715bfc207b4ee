"""Choice of the quickest path to a goal."""
# SPDX-License-Identifier: Apache-2.0
