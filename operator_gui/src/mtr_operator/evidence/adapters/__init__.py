"""Converts the record of a test to formats of other tools: OpenHTF, JUnit, ASAM ODS, MCAP."""
# SPDX-License-Identifier: Apache-2.0
