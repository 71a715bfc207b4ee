"""What the Key press scenario is made of: one press, the search on a radial, the campaign, and what it is shown as."""
# SPDX-License-Identifier: Apache-2.0
