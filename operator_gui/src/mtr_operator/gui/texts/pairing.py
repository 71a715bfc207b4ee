"""Sentences on the keys of the link and on pairing, with {} for what varies; some are of mtr_proto."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "This laptop is not paired with the robot at {}; have the robot show a code, and "
                                  "type it here, or say mtr-operator pair."),
    QT_TRANSLATE_NOOP("Sentence", "The robot does not know this laptop's key, or it was revoked; pair them again."),
    QT_TRANSLATE_NOOP("Sentence", "On the {} port {} is not the robot that was paired: it may be another one, its link "
                                  "may not be encrypted, or the ports may be swapped."),
    QT_TRANSLATE_NOOP("Sentence", "This laptop is paired as a viewer: it sees the robot and cannot move it."),
    QT_TRANSLATE_NOOP("Sentence", "The list of paired robots {} is damaged; delete it and pair anew."),
    QT_TRANSLATE_NOOP("Sentence", "The list of paired robots {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The list of paired robots cannot be written to {}: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The robot at {} does not pair now; have it show a new code."),
    QT_TRANSLATE_NOOP("Sentence", "The robot at {} does not pair on port {}; have it show a code first (rosrun "
                                  "mtr_dispatcher pair)."),
    QT_TRANSLATE_NOOP("Sentence", "The code is wrong; the robot allows a few tries, each a little later."),
    QT_TRANSLATE_NOOP("Sentence", "The code has {} digits; the robot shows it."),
    QT_TRANSLATE_NOOP("Sentence", "The robot's answer does not fit the code; begin anew with a new code."),
    QT_TRANSLATE_NOOP("Sentence", "What has come is no message of a pairing."),
    QT_TRANSLATE_NOOP("Sentence", "Pairing needs the Python package spake2: apt install python3-spake2, or pip install "
                                  "spake2."),
    QT_TRANSLATE_NOOP("Sentence", "The folder {} of the link's keys cannot be made: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The link's keys cannot be written to {}: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The link's keys in {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The link's keys in {} are damaged; delete the file and pair anew."),
    QT_TRANSLATE_NOOP("Sentence", "Others may write {}; say chmod {} {}."),
    QT_TRANSLATE_NOOP("Sentence", "Others may read the secret key in {}; say chmod 600 {}, or delete it and pair "
                                  "anew."),
)
