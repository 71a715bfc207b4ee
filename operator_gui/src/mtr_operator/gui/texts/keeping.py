"""Sentences on what is kept of a test, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "The Car coordinate system is another one than that of {} {}, which gets no more "
                                  "attempts."),
    QT_TRANSLATE_NOOP("Sentence", "The test was begun with the simulated robot; continue it with that one, or begin a "
                                  "new test."),
    QT_TRANSLATE_NOOP("Sentence", "The test was begun with a real robot, and now it is the simulated one; continue it "
                                  "with a real one, or begin a new test."),
    QT_TRANSLATE_NOOP("Sentence", "The test was begun with the simulated Car; continue it with that one, or begin a "
                                  "new test."),
    QT_TRANSLATE_NOOP("Sentence", "The test was begun at a real Car, and now it is the simulated one; continue it at "
                                  "the real one, or begin a new test."),
    QT_TRANSLATE_NOOP("Sentence", "The car profile {} has changed since the test was begun: {}; restore it, or begin "
                                  "a new test."),
    QT_TRANSLATE_NOOP("Sentence", "The file {} has changed since the test was begun."),
    QT_TRANSLATE_NOOP("Sentence", "The test was begun with the car profile {}, and now it is {}; continue it with that "
                                  "of before, or begin a new test."),
    QT_TRANSLATE_NOOP("Sentence", "The test in {} does not say which car profile it had; name one (--car-profile)."),
    QT_TRANSLATE_NOOP("Sentence", "There is no recording of the test in {}; tests of this version and later have one."),
    QT_TRANSLATE_NOOP("Sentence", "Of {} lines nothing was recorded ({})."),
    QT_TRANSLATE_NOOP("Sentence", "Another application (process {}) is measuring the test in the folder {}; end it "
                                  "there first, or choose another folder."),
    QT_TRANSLATE_NOOP("Sentence", "Another application is measuring the test in the folder {}; end it there first, or "
                                  "choose another folder."),
    QT_TRANSLATE_NOOP("Sentence", "The folder {} cannot be locked against other applications: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The files of {} belong to another test; choose another folder."),
    QT_TRANSLATE_NOOP("Sentence", "The test in {} was gone on with since it was opened here; open it again."),
    QT_TRANSLATE_NOOP("Sentence", "{} What was measured is in {}."),
    QT_TRANSLATE_NOOP("Sentence", "{} What was measured is kept in {}, with which the test can be continued."),
    QT_TRANSLATE_NOOP("Sentence", "{} No second place could be written either; what was measured last is in this "
                                  "application only."),
    QT_TRANSLATE_NOOP("Sentence", "A finding cannot be kept, for a value in it is no finite number."),
    QT_TRANSLATE_NOOP("Sentence", "The test's files are not open."),
    QT_TRANSLATE_NOOP("Sentence", "The journal {} is not open."),
    QT_TRANSLATE_NOOP("Sentence", "The journal {} is larger than {} MiB."),
    QT_TRANSLATE_NOOP("Sentence", "The journal {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The journal beside it belongs to another test; move that file elsewhere."),
    QT_TRANSLATE_NOOP("Sentence", "The journal does not fit together; the progress file alone counts."),
    QT_TRANSLATE_NOOP("Sentence", "Of the journal of {}, its last entry was cut off; the {} entries before that are "
                                  "used."),
    QT_TRANSLATE_NOOP("Sentence", "The journal of {} is damaged; its first {} entries are used."),
    QT_TRANSLATE_NOOP("Sentence", "The progress file {} was recovered from its journal. {}"),
    QT_TRANSLATE_NOOP("Sentence", "What was measured last is taken from {}, where it was kept."),
    QT_TRANSLATE_NOOP("Sentence", "Another part of this test, measured apart from this one, is kept in {}."),
    QT_TRANSLATE_NOOP("Sentence", "{} is not used: {}."),
    QT_TRANSLATE_NOOP("Sentence", "it is a link"),
    QT_TRANSLATE_NOOP("Sentence", "it belongs to another user"),
    QT_TRANSLATE_NOOP("Sentence", "other users may write it"),
    # Of names and contents in documents of others.
    QT_TRANSLATE_NOOP("Sentence", "It is damaged: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The file name {} is refused. {}."),
    QT_TRANSLATE_NOOP("Sentence", "The file name {} under photos is refused. {}."),
    QT_TRANSLATE_NOOP("Sentence", "The file name {} is refused. It is a link that leads out of {}."),
    QT_TRANSLATE_NOOP("Sentence", "It is not a text"),
    QT_TRANSLATE_NOOP("Sentence", "It contains a path separator or a colon"),
    QT_TRANSLATE_NOOP("Sentence", "It contains an invisible character"),
    QT_TRANSLATE_NOOP("Sentence", "It begins with a dot"),
    QT_TRANSLATE_NOOP("Sentence", "It begins or ends with a space, or ends with a dot"),
    QT_TRANSLATE_NOOP("Sentence", "Windows reserves it for a device"),
    QT_TRANSLATE_NOOP("Sentence", "File name too long: more than {} bytes"),
    QT_TRANSLATE_NOOP("Sentence", "The folder {} is refused. It is a link that leads out of {}."),
    QT_TRANSLATE_NOOP("Sentence", "The folder {} is a link that leads elsewhere; remove it."),
    QT_TRANSLATE_NOOP("Sentence", "The folder {} is a link that leads elsewhere."),
    QT_TRANSLATE_NOOP("Sentence", "The file {} is a link that leads elsewhere."),
    QT_TRANSLATE_NOOP("Sentence", "The photo {} cannot be copied to {}: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The photo {} is larger than {} MiB."),
    QT_TRANSLATE_NOOP("Sentence", "The photo {} was changed: its check sum is not the recorded one."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: CAN databases must be next to the profile or in the folder set by "
                                  "{}. {}"),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: {} holds no CAN messages."),
    QT_TRANSLATE_NOOP("Sentence", "The store's record of this test is damaged, or written by a newer version; import "
                                  "the test again, or update this program."),
    QT_TRANSLATE_NOOP("Sentence", "The store names the content {}, which is no SHA-256 check sum."),
    QT_TRANSLATE_NOOP("Sentence", "Its Car and its parameters do not fit together. {}"),
    QT_TRANSLATE_NOOP("Sentence", "CAN database {} is larger than {} KiB; leave the messages that the profile does not "
                                  "name out of it."),
    QT_TRANSLATE_NOOP("Sentence", "CAN database {} cannot be read: it is damaged."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {} {}; a profile is a YAML file that names the CAN database."),
    QT_TRANSLATE_NOOP("Sentence", "is larger than {} KiB"),
    QT_TRANSLATE_NOOP("Sentence", "is not a text file in UTF-8"),
    QT_TRANSLATE_NOOP("Sentence", "is not valid YAML"),
    QT_TRANSLATE_NOOP("Sentence", "is not valid YAML in line {}"),
    QT_TRANSLATE_NOOP("Sentence", "is not valid YAML: a value in it cannot be read"),
    QT_TRANSLATE_NOOP("Sentence", "is not valid YAML: too many lists lie within each other"),
    QT_TRANSLATE_NOOP("Sentence", "refers to another part of itself; write the value out"),
    QT_TRANSLATE_NOOP("Sentence", "says {} twice"),
    QT_TRANSLATE_NOOP("Sentence", "says {} in line {}, which YAML takes for {}; write the number that is meant, or the "
                                  "text in quotes"),
    QT_TRANSLATE_NOOP("Sentence", "They are larger than {} KiB."),
    QT_TRANSLATE_NOOP("Sentence", "it is a pipe or a device, and no file"),
    QT_TRANSLATE_NOOP("Sentence", "The folder {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The test in {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The folder {} holds {}, and no {}: what was measured can be read there, and is no "
                                  "test that can be opened."),
    QT_TRANSLATE_NOOP("Sentence", "{} is no file."),
    QT_TRANSLATE_NOOP("Sentence", "The bundle {} was written by a newer version of the application."),
    QT_TRANSLATE_NOOP("Sentence", "The bundle {} holds no {}."),
    QT_TRANSLATE_NOOP("Sentence", "The bundle {} cannot be unpacked: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The bundle {} is not as it was signed. {}"),
    QT_TRANSLATE_NOOP("Sentence", "{} is torn, or no bundle: its list of files cannot be read."),
    QT_TRANSLATE_NOOP("Sentence", "{} is compressed, as no file of a bundle is: it was packed anew; nothing of it was "
                                  "read."),
    QT_TRANSLATE_NOOP("Sentence", "Its files are larger together than it is: it is no bundle; nothing of it was read."),
    QT_TRANSLATE_NOOP("Sentence", "There is no {} or {} in it: it is no bundle."),
    QT_TRANSLATE_NOOP("Sentence", "{} or {} is changed: it cannot be read any more."),
    QT_TRANSLATE_NOOP("Sentence", "{} or {} is changed: the signature is not that of the station's key over it."),
    QT_TRANSLATE_NOOP("Sentence", "{} is missing."),
    QT_TRANSLATE_NOOP("Sentence", "{} is changed."),
    QT_TRANSLATE_NOOP("Sentence", "{} was added."),
    QT_TRANSLATE_NOOP("Sentence", "A file is in it twice."),
    QT_TRANSLATE_NOOP("Sentence", "The bundle {} cannot be written: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The bundle {} was not written as it was signed: {} Check the disk, and write it "
                                  "again."),
    QT_TRANSLATE_NOOP("Sentence", "The bundle was given up, for the window closes."),
    QT_TRANSLATE_NOOP("Sentence", "The chain of bundles in {} is damaged; move that file elsewhere to begin a new "
                                  "chain."),
    QT_TRANSLATE_NOOP("Sentence", "The key of this station in {} cannot be read or made: {}."),
    QT_TRANSLATE_NOOP("Sentence", "Another application is writing a bundle with the key of this station; write this "
                                  "one when it has ended."),
    QT_TRANSLATE_NOOP("Sentence", "The key of this station in {} is damaged; restore it from a copy, or move it "
                                  "elsewhere to have a new one made."),
    QT_TRANSLATE_NOOP("Sentence", "The package duckdb is not installed; pip install duckdb, then bundle the test "
                                  "anew."),
    QT_TRANSLATE_NOOP("Sentence", "It cannot be made: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The scans {} are damaged in line {}, or of another version."),
    QT_TRANSLATE_NOOP("Sentence", "The scans {} cannot be read: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The files are as they were signed, but the zip around them is not as it was "
                                  "written, from byte {} on: it was packed anew, or a byte between the files is "
                                  "changed."),
    # Of the store of results.
    QT_TRANSLATE_NOOP("Sentence", "The store {} is gone."),
    QT_TRANSLATE_NOOP("Sentence", "The store {} is away: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The store {} is away: there is no such file; connect its disk, or name another "
                                  "store."),
    QT_TRANSLATE_NOOP("Sentence", "The store {} is away: there is no folder {}; connect its disk, or make it."),
    QT_TRANSLATE_NOOP("Sentence", "The store {} cannot be used: {}."),
    QT_TRANSLATE_NOOP("Sentence", "The store {} failed: {}"),
    QT_TRANSLATE_NOOP("Sentence", "The database {} holds no store yet; mtr-results import makes one."),
    QT_TRANSLATE_NOOP("Sentence", "The database holds tables of another program; give the store one of its own."),
    QT_TRANSLATE_NOOP("Sentence", "The store {} has version {}, and this program version {}; keep a copy, then bring "
                                  "it up to date with mtr-results upgrade."),
    QT_TRANSLATE_NOOP("Sentence", "The store {} has version {}, which is newer than version {} of this program; "
                                  "install the newer program."),
    QT_TRANSLATE_NOOP("Sentence", "{} is no address of a store; give the path of a file, or "
                                  "postgresql://USER:PASSWORD@HOST/DATABASE."),
    QT_TRANSLATE_NOOP("Sentence", "There is no test {} in the store; mtr-results list shows their numbers."),
    QT_TRANSLATE_NOOP("Sentence", "another program has been writing to it for too long; try again when that has ended"),
    QT_TRANSLATE_NOOP("Sentence", "its disk is full; make room"),
    QT_TRANSLATE_NOOP("Sentence", "its file cannot be opened; look for the folder and its rights"),
    QT_TRANSLATE_NOOP("Sentence", "its file may not be written; look for its rights"),
    QT_TRANSLATE_NOOP("Sentence", "its disk is full, or has errors; make room, and look at the disk"),
    QT_TRANSLATE_NOOP("Sentence", "no database server answers there; look whether it runs, and at the address"),
    QT_TRANSLATE_NOOP("Sentence", "the connection to the database server broke"),
    QT_TRANSLATE_NOOP("Sentence", "the file is none of a store"),
    QT_TRANSLATE_NOOP("Sentence", "its file is damaged; take the last copy of it"),
    QT_TRANSLATE_NOOP("Sentence", "the database server refuses this user or password"),
    QT_TRANSLATE_NOOP("Sentence", "there is no such database or user on the server"),
)
