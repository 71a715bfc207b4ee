"""States of a widget that the style sheet paints: "stale", "role", "moving"."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from PyQt5.QtWidgets import QWidget


def show_state(widget: QWidget, name: str, value: object) -> None:
    """Give a widget a property, and paint it anew by the style sheet when that changes it."""
    if widget.property(name) == value:
        return
    widget.setProperty(name, value)
    widget.style().unpolish(widget)
    widget.style().polish(widget)
