"""What tests say of each other. Pure: no database, no files."""
# SPDX-License-Identifier: Apache-2.0
