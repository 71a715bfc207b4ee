"""Templates of distances, and what they mean."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

TEMPLATES = (
    QT_TRANSLATE_NOOP("Figure", "{first}"),
    QT_TRANSLATE_NOOP("Figure", "at least {first}"),
    QT_TRANSLATE_NOOP("Figure", "at most {first}"),
    QT_TRANSLATE_NOOP("Figure", "{first} to {second}"),
    QT_TRANSLATE_NOOP("Figure", "not reached"),
    QT_TRANSLATE_NOOP("Figure", "unknown"),
    QT_TRANSLATE_NOOP("Figure", "invalid"),
    QT_TRANSLATE_NOOP("Figure", "key"),
)
SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "Beside each distance stands 1 sigma of where the Remote key was at this one event; "
                                  "at another attempt the Car may react elsewhere, by more than that."),
    QT_TRANSLATE_NOOP("Sentence", "Beside each distance stands 1 sigma of the boundary, and its 95 % interval: in 95 "
                                  "of 100 tests like this one "
                                  "it holds where the Car decides either way equally often."),
    QT_TRANSLATE_NOOP("Sentence", "Of a range between two places the nearer one is the farthest press that worked, the "
                                  "other the next one that failed; a range of at least a place worked at the first."),
)
