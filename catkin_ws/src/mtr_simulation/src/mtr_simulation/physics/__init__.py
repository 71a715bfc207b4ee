"""The robot as a body: MuJoCo's model of it and of its site, tyres on the ground, the base's own speed control."""
# SPDX-License-Identifier: Apache-2.0
