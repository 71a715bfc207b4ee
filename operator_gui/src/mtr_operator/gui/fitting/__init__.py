"""What makes windows fit the screen: where they open, and what scrolls in them."""
# SPDX-License-Identifier: Apache-2.0
