"""Complete robot on the wall clock, on an idle and on a busy machine: silences, latencies and load."""
# SPDX-License-Identifier: Apache-2.0
