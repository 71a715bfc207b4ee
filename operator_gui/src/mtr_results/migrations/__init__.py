"""Versions of the store's tables, by Alembic."""
# SPDX-License-Identifier: Apache-2.0

# Version that this program reads and writes: the last file in `versions`; a test compares both.
HEAD = "0001"
