"""A command line in a process of its own, with a witness that notes what it measures, orders and shows.

What the witness has noted stays when the process is killed, for the note is the system's at once.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import os

from mtr_operator.cli.commands import run_command
from mtr_operator.cli.display import Display
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.results.journal import plain_fields
from mtr_operator.robot_link.fake import FakeRobotLink

MEASURED, ORDERED, SHOWN = "measured", "ordered", "shown"


def begin(arguments, said, notes):
    """Fork a process that runs the command line; its number. said, notes: files that it appends to."""
    process = os.fork()
    if process:
        return process
    try:
        stream = os.open(said, os.O_WRONLY | os.O_CREAT | os.O_APPEND)
        os.dup2(stream, 1)
        os.dup2(stream, 2)
        _watch(os.open(notes, os.O_WRONLY | os.O_CREAT | os.O_APPEND))
        code = run_command([str(argument) for argument in arguments])
    except BaseException as error:
        os.write(2, f"uncaught: {type(error).__name__}: {error}\n".encode())
        code = 70
    os._exit(code)


def _watch(notes):
    """Have the process note what it does, each before it is done."""
    pending = []

    def note(what, value):
        os.write(notes, (json.dumps([what, value]) + "\n").encode())

    def keep(robot, word, status, distance=None, **more):
        value = [word, status.value, None if distance is None else plain_fields(distance)]
        note(MEASURED, value)
        pending.append(value)
        former_keep(robot, word, status, distance, **more)

    def send(link, desired):
        while pending:
            note(ORDERED, pending.pop())
        former_send(link, desired)

    def on_result(display, result, done, total):
        note(SHOWN, result.to_document())
        former_on_result(display, result, done, total)

    former_keep, Robot.keep = Robot.keep, keep
    former_send, FakeRobotLink.send = FakeRobotLink.send, send
    former_on_result, Display.on_result = Display.on_result, on_result


def read_notes(path):
    """Pairs of what and value, in order."""
    if not path.exists():
        return []
    whole, _, _ = path.read_text(encoding="utf-8").rpartition("\n")
    return [tuple(json.loads(line)) for line in whole.splitlines()]
