"""The whole robot on the wall clock, on an idle and on a busy machine: silences, latencies, load."""
# SPDX-License-Identifier: Apache-2.0
