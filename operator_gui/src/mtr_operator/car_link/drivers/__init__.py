"""What the drivers of CAN adapters differ in: how one only listens, carries CAN FD, and tells what is wrong."""
# SPDX-License-Identifier: Apache-2.0
