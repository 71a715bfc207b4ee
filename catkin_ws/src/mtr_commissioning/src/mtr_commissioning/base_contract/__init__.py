"""Requirements on a four-wheel base, as checks: its URDF, its controller's parameters, its topics."""
# SPDX-License-Identifier: Apache-2.0
