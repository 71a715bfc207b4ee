"""Sentences on the supervision of a test."""
# SPDX-License-Identifier: Apache-2.0
