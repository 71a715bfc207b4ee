"""Sentences on what a Car tells beside its locks and how it is asked for them, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: signal must be a name, or a table from the name of a door to its "
                                  "signal."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: buses must be a table from the name of a further bus to its CAN "
                                  "database."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: doors must be a table from the name of a door to its signal."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} must be a list of tables."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} names the bus {}, which is not in buses."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} is on the bus {} and names no message."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} has {}: {}; allowed is a whole number."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} has {}: {}; allowed is a list of whole numbers."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: uds_poll must be a table of {}; needed are {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: uds_poll has {}: {}; allowed is {} to {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} must be a table of {}."),
    QT_TRANSLATE_NOOP("Sentence", "The car profile {} asks the Car for its lock state (uds_poll), and the CAN adapter "
                                  "only listens; choose normal mode (--can-normal) where the Car may be asked, or a "
                                  "profile with a state that it sends."),
    QT_TRANSLATE_NOOP("Sentence", "The car profile needs the bus {}, too; name its adapter (--can-bus "
                                  "{}=INTERFACE:CHANNEL:BITRATE)."),
    QT_TRANSLATE_NOOP("Sentence", "Further bus {}: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The CAN adapter {} ({}) is that of another bus already; give each bus an adapter of "
                                  "its own."),
    QT_TRANSLATE_NOOP("Sentence", "Message {} comes every {} s, and {} says {} s; the uncertainty of a change rests on "
                                  "it: correct it."),
    QT_TRANSLATE_NOOP("Sentence", "Message {} (id {}) comes without the signal {}: another page of a multiplexed "
                                  "message, or a shorter one than the database says; check the car profile."),
    QT_TRANSLATE_NOOP("Sentence", "The signal {} of the Car's message {} went from {} to {}."),
    QT_TRANSLATE_NOOP("Sentence", "The signal {} of the Car's message {} stands still at {}."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's bus tells that {} is open; leave the Car's doors closed during the test."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's bus names two causes of one change, {} and {}."),
    QT_TRANSLATE_NOOP("Sentence", "The key with the number {} moved the Car's locks, and number {} is under test."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's locks moved on its bus, and {} counted nothing."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's bus did not say which key moved its locks, and number {} is under test; "
                                  "increase cause_within_s of the car profile if it says so later."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's locks moved on its bus, and {} was silent; increase cause_within_s of the "
                                  "car profile if it counts later."),
    QT_TRANSLATE_NOOP("Sentence", "The Car's locks moved while {} was open."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} by something that its profile does not list ({}), not by {}; leave "
                                  "its doors and switches alone during the test."),
    QT_TRANSLATE_NOOP("Sentence", "Message {} of CAN database {} cannot be used: {}."),
    QT_TRANSLATE_NOOP("Sentence", "Signal {} of message {} of CAN database {} cannot be used: {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} is {}; allowed are the lowest and the highest value of "
                                  "the counter, such as [0, {}], up to {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: states names values for locked and unlocked that the signal "
                                  "{} of {} bits cannot carry."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} has {} and {}, which are the same bits, with two "
                                  "meanings."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: no signal can carry a value that states lists as {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} belongs to {}, which is missing."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} belongs to {}, which is missing or false."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} is {}, which is only sent on change; name another "
                                  "message."),
    QT_TRANSLATE_NOOP("Sentence", "Message {} (id 0x{}) comes on the bus of the state and on the bus {}; that "
                                  "of the first one counts. Check that the adapters are at the buses that the "
                                  "profile names."),
    QT_TRANSLATE_NOOP("Sentence", "Message {} (id 0x{}) comes on several channels of the log, {} among them, "
                                  "and the car profile does not say which is which; name the further buses "
                                  "(buses)."),
)
