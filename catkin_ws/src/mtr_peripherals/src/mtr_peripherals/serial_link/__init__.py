"""Host side of the serial line to the firmware: the rosserial protocol, revision 2."""
# SPDX-License-Identifier: Apache-2.0
