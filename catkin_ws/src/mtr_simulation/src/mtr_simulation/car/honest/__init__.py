"""The honest Car: it fades, polls, lapses, sleeps and talks on its bus as real cars do."""
# SPDX-License-Identifier: Apache-2.0
