"""Sentences on learning a Car from its bus, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "The number of prompts is {}; allowed are even numbers from {} to {}."),
    QT_TRANSLATE_NOOP("Sentence", "Nothing came over the bus; check bit rate, plug and whether the Car is awake."),
    QT_TRANSLATE_NOOP("Sentence", "Nothing came over the bus in {} s; check bit rate, plug and whether the Car is "
                                  "awake."),
    QT_TRANSLATE_NOOP("Sentence", "No bit of any message followed all prompts; repeat it, and act only when asked. A "
                                  "Car that tells its locks on another bus cannot be learned from this one."),
    QT_TRANSLATE_NOOP("Sentence", "The profile is called {}; allowed are letters, digits, - and _, and .yaml at the "
                                  "end."),
    QT_TRANSLATE_NOOP("Sentence", "The file {} is there already; choose another name."),
    QT_TRANSLATE_NOOP("Sentence", "The input has ended before all prompts were answered; learn needs a terminal."),
    QT_TRANSLATE_NOOP("Sentence", "{} more messages followed all prompts as well, such as lights or mirrors; the one "
                                  "that came first is proposed. Compare it with the Car's documents."),
    QT_TRANSLATE_NOOP("Sentence", "If what stands still between the prompts were chance, {} bits would follow all of "
                                  "them; more prompts make it surer."),
    QT_TRANSLATE_NOOP("Sentence", "What is proposed also changed when nobody was asked to act; repeat it, and act only "
                                  "when asked."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN database {} has no signal where it was found; the profile gets a database "
                                  "of its own."),
    QT_TRANSLATE_NOOP("Sentence", "counter {}"),
    QT_TRANSLATE_NOOP("Sentence", "counts changes {}"),
    QT_TRANSLATE_NOOP("Sentence", "check sum in byte {}"),
    QT_TRANSLATE_NOOP("Sentence", "{} more changes"),
    QT_TRANSLATE_NOOP("Sentence", "not cyclic"),
    QT_TRANSLATE_NOOP("Sentence", "The profile {} was written, and does not understand {} of the {} frames from "
                                  "which it was learned; learn again with more prompts."),
)
