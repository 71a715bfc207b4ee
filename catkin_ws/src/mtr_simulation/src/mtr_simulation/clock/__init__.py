"""What the simulated clock waits for."""
# SPDX-License-Identifier: Apache-2.0
