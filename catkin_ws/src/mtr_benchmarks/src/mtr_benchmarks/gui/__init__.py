"""How fast the Operator's window answers and paints, and what it takes of the laptop."""
# SPDX-License-Identifier: Apache-2.0
