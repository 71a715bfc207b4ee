"""The tables of the store."""
# SPDX-License-Identifier: Apache-2.0
