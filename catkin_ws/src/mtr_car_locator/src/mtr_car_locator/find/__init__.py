"""Search for the Car in surfaces: one rectangle, or a sentence with the reason for a failure."""
# SPDX-License-Identifier: Apache-2.0
