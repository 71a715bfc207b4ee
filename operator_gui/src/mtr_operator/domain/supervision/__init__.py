"""Supervision of a test: the Car's signals, the person in charge, and the conditions confirmed before it starts."""
# SPDX-License-Identifier: Apache-2.0
