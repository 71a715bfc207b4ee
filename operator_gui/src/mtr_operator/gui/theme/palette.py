"""The colours of the themes, by role. Contrasts are tested against WCAG 2.1 AA, those of high contrast against AAA."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Palette:
    """Colours as #rrggbb.

    Attributes:
        window, surface, raised: backgrounds from far to near. line: decoration. border: of fields.
        ink, ink_soft: texts. accent, on_accent: what is chosen, and text on it. tint, on_tint: what is finished.
        ok, warning, danger: meanings, readable as text on window and surface. on_signal: text on these.
        stop, on_stop: the button that stops the robot while it may move, red in all themes, and text on it.
        body, glass, edge: the Car in pictures. robot, robot_mark, key: the robot in pictures.
        trail, waypoint: its way.
        first, second, failed, invalid: results, told apart by colour-blind readers too (Okabe and Ito).
    """

    window: str
    surface: str
    raised: str
    line: str
    border: str
    ink: str
    ink_soft: str
    accent: str
    on_accent: str
    tint: str
    on_tint: str
    ok: str
    warning: str
    danger: str
    on_signal: str
    stop: str
    on_stop: str
    body: str
    glass: str
    edge: str
    robot: str
    robot_mark: str
    key: str
    trail: str
    waypoint: str
    first: str
    second: str
    failed: str
    invalid: str


LIGHT = Palette(
    window="#eef1f4", surface="#ffffff", raised="#e1e7ed", line="#cdd6de", border="#74818d",
    ink="#14202b", ink_soft="#44525f", accent="#0b57a4", on_accent="#ffffff", tint="#cfe2f5", on_tint="#0a3a6b",
    ok="#17663a", warning="#7d4b00", danger="#ad1f18", on_signal="#ffffff",
    stop="#c4160f", on_stop="#ffffff",
    body="#dfe3e8", glass="#8fa3b8", edge="#39424e", robot="#f2a900", robot_mark="#14202b", key="#117a43",
    trail="#6f7f8e", waypoint="#0b57a4", first="#0072b2", second="#c24e00", failed="#a61c3c", invalid="#6a3d9a")

DARK = Palette(
    window="#10161c", surface="#1a222b", raised="#28333e", line="#3a4753", border="#8796a4",
    ink="#f1f5f8", ink_soft="#bcc8d2", accent="#7cbcfb", on_accent="#06203a", tint="#1f4468", on_tint="#dcecfc",
    ok="#74d99a", warning="#f6bf5c", danger="#ff9b92", on_signal="#10161c",
    stop="#d3261d", on_stop="#ffffff",
    body="#3b4754", glass="#66798b", edge="#c3ced8", robot="#f5bd3d", robot_mark="#10161c", key="#5fd391",
    trail="#8796a4", waypoint="#7cbcfb", first="#5cb8ee", second="#f59a5b", failed="#ff8fa6", invalid="#c9a4f0")

# For bright sun and weak eyes.
CONTRAST = Palette(
    window="#000000", surface="#000000", raised="#1c1c1c", line="#9a9a9a", border="#ffffff",
    ink="#ffffff", ink_soft="#e6e6e6", accent="#ffe100", on_accent="#000000", tint="#003f7d", on_tint="#ffffff",
    ok="#3dff8f", warning="#ffcc4d", danger="#ff9088", on_signal="#000000",
    stop="#ff5f57", on_stop="#000000",
    body="#3a3a3a", glass="#8a8a8a", edge="#ffffff", robot="#ffd21f", robot_mark="#000000", key="#4dffa6",
    trail="#bdbdbd", waypoint="#ffe100", first="#56c8ff", second="#ffad5c", failed="#ff9fb5", invalid="#d3b3ff")

THEMES = {"light": LIGHT, "dark": DARK, "contrast": CONTRAST}


def contrast(one: str, other: str) -> float:
    """Contrast ratio of two colours by WCAG 2.1, 1 to 21."""
    lighter, darker = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour: str) -> float:
    parts = [int(colour[index:index + 2], 16) / 255.0 for index in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
