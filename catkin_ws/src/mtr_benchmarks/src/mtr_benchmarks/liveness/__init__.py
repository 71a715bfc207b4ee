"""The whole robot on the machine's clock while its nodes are stopped for a while, or the clock is set."""
# SPDX-License-Identifier: Apache-2.0
