"""How true the ranges of both scenarios are on Cars that fade, lapse and poll, against what must hold."""
# SPDX-License-Identifier: Apache-2.0
