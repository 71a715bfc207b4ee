"""Studies that ship: a plan each, and the picture of what came of it."""
# SPDX-License-Identifier: Apache-2.0
