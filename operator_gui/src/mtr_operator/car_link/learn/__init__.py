"""Learning a new car's profile from its bus while a person locks and unlocks it."""
# SPDX-License-Identifier: Apache-2.0
