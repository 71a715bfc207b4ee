"""Sources of the distance of a phone that is the Car's key: the Car's bus, a TCP connection, a serial line."""
# SPDX-License-Identifier: Apache-2.0
