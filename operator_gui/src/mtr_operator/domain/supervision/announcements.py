"""What a test may have the Car do to people next to it: they are warned before it begins."""
# SPDX-License-Identifier: Apache-2.0

# The buttons of a key: its panic button, a horn that confirms, a tailgate that opens.
BUTTONS = ("A press may sound the horn or the alarm, or open the tailgate. Announce the test; people next to the Car "
           "wear ear protection.")
# A pull at a locked Car, and a key that the Car takes for one locked in.
HANDLES = ("A pull at the handle of a locked Car may set off its alarm. Announce the test; people next to the Car wear "
           "ear protection.")
LOCKS = ("The Car may sound its horn when it locks or unlocks. Announce the test; people next to the Car wear ear "
         "protection.")
