"""Sentences on the adapter of the Car's bus and how it is opened, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "the adapter's clock"),
    QT_TRANSLATE_NOOP("Sentence", "the kernel's clock"),
    QT_TRANSLATE_NOOP("Sentence", "this computer's clock when they are read"),
    QT_TRANSLATE_NOOP("Sentence", "CAN FD data bit rate is {}; allowed is {}, the bit rate, to {} bit/s."),
    QT_TRANSLATE_NOOP("Sentence", "python-can's driver {} cannot open an adapter so that it only listens; use one of "
                                  "{}, or choose normal mode (--can-normal) for a bench of one node."),
    QT_TRANSLATE_NOOP("Sentence", "python-can's driver {} has no CAN FD; use one of {}, or leave the data bit rate out "
                                  "for classic CAN."),
    QT_TRANSLATE_NOOP("Sentence", "The {} does not take the order to listen only; end other programs that use it, take "
                                  "another adapter, or choose normal mode (--can-normal) for a bench of one node."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN adapter does not take the order to listen only (L of slcan), and stays "
                                  "closed; use another adapter or firmware, or choose normal mode (--can-normal) for "
                                  "a bench of one node."),
    QT_TRANSLATE_NOOP("Sentence", "python-can's driver {} has no bit rate of {} bit/s; use one of {}."),
    QT_TRANSLATE_NOOP("Sentence", "python-can's driver ixxat is for Windows with the vendor's VCI; on Linux use the "
                                  "kernel's interface of the adapter (socketcan)."),
    QT_TRANSLATE_NOOP("Sentence", "Whether the CAN interface {} only listens is not known, for the program ip does not "
                                  "tell; see that it is there and up, install iproute2, or choose normal mode "
                                  "(--can-normal) for a bench of one node."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN interface {} takes part in the bus; have it only listen by {}, or choose "
                                  "normal mode (--can-normal) for a bench of one node."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN interface {} runs at {} bit/s, and {} bit/s is chosen; set one of them as "
                                  "the Car's bus is."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN adapter has lost frames: they were not read in time; end other programs, or "
                                  "use an adapter with more room for them."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's bus carries CAN FD frames, and the adapter was opened for classic CAN; "
                                  "give the data bit rate of the bus."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN bus brings error frames ({}) and not one frame at {} bit/s: the bit rate is "
                                  "another one, or the bus carries CAN FD."),
    QT_TRANSLATE_NOOP("Sentence", "A CAN log of the format mf4 needs the Python package asammdf, which is not "
                                  "installed; install it, or choose blf."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log {} cannot be written: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log {} needs the Python package asammdf, which is not installed."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log {} cannot be read: it is damaged or of another format."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log {} holds no frame."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log {} has come to its end."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log is not open."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log {} has a gap of {} s after {} frames; a change within it is as "
                                  "uncertain as the gap is long."),
    QT_TRANSLATE_NOOP("Sentence", "The time of the CAN log {} jumps back by {} s after {} frames; what lies about it "
                                  "is not to be believed."),
    QT_TRANSLATE_NOOP("Sentence", "The course {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The course {} is damaged; it is no text."),
    QT_TRANSLATE_NOOP("Sentence", "The course {} is damaged in line {}, or of another version."),
    QT_TRANSLATE_NOOP("Sentence", "The car's profile names an output that takes the handle, and the CAN adapter only "
                                  "listens: a person takes it; choose normal mode (--can-normal) to have it switched."),
    QT_TRANSLATE_NOOP("Sentence", "{} is no CAN log: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log {} names the buses {}, and only names with different numbers, "
                                  "such as can0 and can1, say which is which."),
    QT_TRANSLATE_NOOP("Sentence", "A CAN log of the format {} holds no CAN FD frame; choose blf or asc "
                                  "(--can-log-format)."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log {} holds no frame that is understood: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The CAN log {} holds no frame: {}; read are {}."),
    QT_TRANSLATE_NOOP("Sentence", "Message {} (id {}) comes only on the bus {}, and the car profile expects it on the "
                                  "bus of the state. Swap the adapters; in a log, number the channels so that the bus "
                                  "of the state is channel 0 and the bus {} is channel {}."),
    QT_TRANSLATE_NOOP("Sentence", "Message {} (id {}) comes only on {} of the log, and the car profile expects it on "
                                  "channel 0, because it names further buses (buses). Number the channels of the log "
                                  "so that the bus of the state is channel 0."),
    QT_TRANSLATE_NOOP("Sentence", "several messages refer to the same signals too often"),
)
