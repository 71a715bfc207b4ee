"""This laptop's keys, the robots that it is paired with, and pairing."""
# SPDX-License-Identifier: Apache-2.0
