"""Plans: varied factors, design, and the resulting runs."""
# SPDX-License-Identifier: Apache-2.0
