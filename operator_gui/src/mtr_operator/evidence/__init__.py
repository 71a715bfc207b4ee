"""Evidence of a test for a laboratory: one signed file with all data, and the proof that it is unchanged."""
# SPDX-License-Identifier: Apache-2.0
