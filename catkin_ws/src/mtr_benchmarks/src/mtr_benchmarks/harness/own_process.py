"""Runs a function in its own process; when either process is terminated, both release their resources."""
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

# prctl(2): the signal that a process receives when its parent has ended, for whatever reason.
_PR_SET_PDEATHSIG = 1
# Offset of a shell's exit status for a process that was ended by a signal.
_BY_SIGNAL = 128


class OwnProcessError(Exception):
    """The process ended without a result; its standard error has the reason."""


def end_in_order() -> None:
    """Handle SIGTERM like sys.exit from now on, so that robots are stopped and disks are unmounted."""
    signal.signal(signal.SIGTERM, _end)


def in_own_process(function: Callable[..., R], *arguments: Any) -> R:
    """Return the result of an importable function; terminate its process when this one ends.

    Raises:
        OwnProcessError: the process ended without a result.
    """
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
    # Ctrl-C reaches all processes of a terminal; the waiting parent passes it on as SIGTERM.
    signal.signal(signal.SIGINT, _ignore)
    end_in_order()
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
    # The parent may have ended before the call of prctl.
    if os.getppid() == parent:
        sender.send(function(*arguments))


def _end(number: int, _frame: Optional[FrameType]) -> None:
    # A repeated request must not interrupt the cleanup.
    signal.signal(number, _ignore)
    sys.exit(_BY_SIGNAL + number)


def _ignore(_number: int, _frame: Optional[FrameType]) -> None:
    """Ignore the signal. SIG_IGN would be inherited by started programs."""
