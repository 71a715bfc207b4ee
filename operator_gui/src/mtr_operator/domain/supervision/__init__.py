"""Supervision of a test: the Car's signals, the person in charge, and what has to be confirmed before it begins."""
# SPDX-License-Identifier: Apache-2.0
