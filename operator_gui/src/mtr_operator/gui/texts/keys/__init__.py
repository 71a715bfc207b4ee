"""Texts on keys of one kind."""
# SPDX-License-Identifier: Apache-2.0
