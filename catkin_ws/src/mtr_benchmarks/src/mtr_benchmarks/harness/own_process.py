"""A function in a process of its own, and the end of both: whoever is ended closes what it has opened."""
# SPDX-License-Identifier: Apache-2.0
import ctypes
import os
import signal
import sys
from multiprocessing import get_context
from multiprocessing.connection import Connection
from types import FrameType
from typing import Any, Callable, Optional, Tuple, TypeVar

R = TypeVar("R")

# prctl(2): the signal that a process gets when the one that started it has ended, however that ended.
_PR_SET_PDEATHSIG = 1
# As a shell reports who was ended by a signal.
_BY_SIGNAL = 128


class OwnProcessError(Exception):
    """The process ended without a result; what it had to say about that is on its standard error."""


def end_in_order() -> None:
    """From now on a request to terminate ends this process like sys.exit: robots are ended, disks are unmounted."""
    signal.signal(signal.SIGTERM, _end)


def in_own_process(function: Callable[..., R], *arguments: Any) -> R:
    """Result of an importable function, which ends in order when this process does; OwnProcessError without one."""
    context = get_context("spawn")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(sender, os.getpid(), function, arguments))
    process.start()
    sender.close()
    try:
        result: R = receiver.recv()
    except EOFError:
        process.join()
        raise OwnProcessError(f"{function.__name__} ended with status {process.exitcode}.") from None
    except BaseException:
        process.terminate()
        raise
    finally:
        process.join()
        receiver.close()
    return result


def _work(sender: Connection, parent: int, function: Callable[..., Any], arguments: Tuple[Any, ...]) -> None:
    # Ctrl-C reaches all processes of a terminal: the one that waits for this one passes it on.
    signal.signal(signal.SIGINT, _ignore)
    end_in_order()
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
    # It may have ended before that.
    if os.getppid() == parent:
        sender.send(function(*arguments))


def _end(number: int, _frame: Optional[FrameType]) -> None:
    # Whoever closes what is open must not be broken off by the same request again.
    signal.signal(number, _ignore)
    sys.exit(_BY_SIGNAL + number)


def _ignore(_number: int, _frame: Optional[FrameType]) -> None:
    """Not SIG_IGN, which programs that are started from here would inherit."""
