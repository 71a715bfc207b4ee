"""Sentences that come from below the window, in the language in use: by template, with the values put in.

The domain, the links and the robot speak English. Each template is the English sentence with {} for what varies; one
that is not listed is shown as it is.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations


def translated(sentence: str) -> str:
    """The sentence in the language in use."""
    return sentence
