"""Events of robot, Car and test as one list of sentences for the Operator."""
# SPDX-License-Identifier: Apache-2.0
