"""Versions of the store's tables, by Alembic."""
# SPDX-License-Identifier: Apache-2.0

# The version that this program reads and writes: the last file in `versions`, which a test compares.
HEAD = "0001"
