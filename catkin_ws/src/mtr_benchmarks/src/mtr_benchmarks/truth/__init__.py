"""Whether a line that says a distance is right, whatever disturbs it: lines of a simulated world against its truth."""
# SPDX-License-Identifier: Apache-2.0
