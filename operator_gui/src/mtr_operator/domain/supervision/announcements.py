"""Warnings to people next to the Car, given before a test that may affect them."""
# SPDX-License-Identifier: Apache-2.0

# A key's buttons may trigger the panic alarm, a confirming horn, or the tailgate.
BUTTONS = ("A press may sound the horn or the alarm, or open the tailgate. Announce the test; people next to the Car "
           "wear ear protection.")
# The alarm may react to a pull at a locked Car, or to a key that the Car assumes locked in.
HANDLES = ("A pull at the handle of a locked Car may set off its alarm. Announce the test; people next to the Car wear "
           "ear protection.")
LOCKS = ("The Car may sound its horn when it locks or unlocks. Announce the test; people next to the Car wear ear "
         "protection.")
