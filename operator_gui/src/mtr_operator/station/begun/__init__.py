"""Starting tests, and unfinished tests."""
# SPDX-License-Identifier: Apache-2.0
