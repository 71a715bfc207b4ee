"""The record of a test as other tools read it: OpenHTF, JUnit, ASAM ODS, MCAP."""
# SPDX-License-Identifier: Apache-2.0
