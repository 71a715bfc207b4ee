"""What a four-wheel base has to give, as checks: its URDF, its controller's parameters, its topics."""
# SPDX-License-Identifier: Apache-2.0
