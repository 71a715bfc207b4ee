"""Results for people: results.csv and protocol.png."""
# SPDX-License-Identifier: Apache-2.0
