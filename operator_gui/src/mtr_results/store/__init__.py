"""Access to the store: opening, writing, reading, and the spool of waiting tests."""
# SPDX-License-Identifier: Apache-2.0
