"""Sentences on handle requests and what is measured by them, with {} for what varies."""
# SPDX-License-Identifier: Apache-2.0
from PyQt5.QtCore import QT_TRANSLATE_NOOP

SENTENCES = (
    QT_TRANSLATE_NOOP("Sentence", "handle request at {} m"),
    QT_TRANSLATE_NOOP("Sentence", "the handle request at {} m"),
    QT_TRANSLATE_NOOP("Sentence", "have the Car locked again"),
    QT_TRANSLATE_NOOP("Sentence", "{} requests on each axis reach an interval of {} m where the Car's range ends "
                                  "within {} m; interval_m asks for {} m: allow {} requests (attempts_limit), or "
                                  "ask for {} m."),
    QT_TRANSLATE_NOOP("Sentence", "{} requests on each axis reach an interval of {} m where the Car's range ends "
                                  "within {} m; interval_m asks for {} m: ask for {} m."),
    QT_TRANSLATE_NOOP("Sentence", "Nobody takes the Car's handle: its profile declares no handle_request, and there "
                                  "is no Operator to ask; add one to the profile, or start the test where a person "
                                  "can answer."),
    QT_TRANSLATE_NOOP("Sentence", "Nobody has taken the Car's handle within {} s; continue the test when somebody "
                                  "is there to do it, or increase handle_timeout_s."),
    QT_TRANSLATE_NOOP("Sentence", "The handle was taken {} times only after the key had stood for more than {} s, "
                                  "when it may sleep; take it sooner, or increase key_rest_limit_s if the key stays "
                                  "awake."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was not locked again, not even {} s after the key had gone away; lock it, "
                                  "and see whether its key's lock button and its own lock work."),
    QT_TRANSLATE_NOOP("Sentence", "The Car was {} by its handle, not by {}; leave its handles alone during the test."),
    QT_TRANSLATE_NOOP("Sentence", "No handle request unlocked the Car, and none of {} at {} m either: the key "
                                  "sleeps, its battery is empty, the handle was not taken, or the zone ends nearer; "
                                  "then decrease minimum_distance_m."),
    QT_TRANSLATE_NOOP("Sentence", "No handle request has unlocked the Car on {} axes one after the other; see "
                                  "whether the key sleeps, whether its battery is empty, whether it is the Car's "
                                  "key and whether the handle of this side is taken, then continue the test, or "
                                  "begin one of another side or with a smaller minimum_distance_m."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter minimum_distance_m leaves {} m up to the first request at {} m; the "
                                  "search needs {} m."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter minimum_distance_m is {} m; allowed is clearance_m, {} m, and more."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter border_distance_m is {} m; allowed is {} to {} m, where requests are "
                                  "made."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter border_requests is {}; allowed is at most attempts_limit, {}."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter highest_key_height_m is {} m; it has to be above key_height_m, {} m."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: handle_request must be a table of {}."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: handle_request has {}: {}; allowed is a whole number."),
    QT_TRANSLATE_NOOP("Sentence", "Car profile {}: taken and released of handle_request are both {}; give two "
                                  "values."),
    QT_TRANSLATE_NOOP("Sentence", "Signal {} of message {} cannot carry the value {}."),
    QT_TRANSLATE_NOOP("Sentence", "trial {}: the key is held still for {} s"),
    QT_TRANSLATE_NOOP("Sentence", "a trial was disturbed and is made again"),
    QT_TRANSLATE_NOOP("Sentence", "move the key: it has to answer then"),
    QT_TRANSLATE_NOOP("Sentence", "asleep after {} to {} s"),
    QT_TRANSLATE_NOOP("Sentence", "asleep after {} s at most"),
    QT_TRANSLATE_NOOP("Sentence", "awake for at least {} s"),
    QT_TRANSLATE_NOOP("Sentence", "The Remote key was moved while it was to be held still."),
    QT_TRANSLATE_NOOP("Sentence", "Nobody knows since when the Remote key has been at rest."),
    QT_TRANSLATE_NOOP("Sentence", "The key did not answer {} requests at {} m right after it was moved: the place lies "
                                  "outside the zone, the key's battery is empty, it is not the Car's key, or the "
                                  "handle of this side was not taken."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter wake_move_m is {} m; allowed is at most {} m, up to maximum_distance_m."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter interval_s is {} s; allowed is more than {} s, for the requests to a "
                                  "silent key take half of that; decrease requests or response_timeout_s."),
    QT_TRANSLATE_NOOP("Sentence", "Parameter longest_wait_s is {} s; it has to be longer than shortest_wait_s, {} s."),
)
