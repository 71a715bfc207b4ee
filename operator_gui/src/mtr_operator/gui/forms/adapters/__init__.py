"""Fields of a CAN adapter: of the Car's bus, and of each further bus that its profile declares."""
# SPDX-License-Identifier: Apache-2.0
