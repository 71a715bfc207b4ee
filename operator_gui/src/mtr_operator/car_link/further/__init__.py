"""What a Car tells beside the state of its locks, in whichever messages and on whichever buses."""
# SPDX-License-Identifier: Apache-2.0
