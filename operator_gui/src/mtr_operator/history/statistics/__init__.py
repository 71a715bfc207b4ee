"""Statistics of several tests for window, command line and store: each difference with its interval, and among all."""
# SPDX-License-Identifier: Apache-2.0
