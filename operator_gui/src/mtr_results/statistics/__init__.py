"""Statistical comparison of tests. Pure: no database, no files."""
# SPDX-License-Identifier: Apache-2.0
