"""The worker process of a ProcessExecutor: python3 -m mtr_core.executors.worker HANDLE [MODULE...]."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import importlib
import os
import signal
import sys
from multiprocessing.connection import Connection
from typing import List, Optional

from .process import GONE

# Lower priority than the nodes, whose messages have deadlines.
NICENESS = 5


def main(arguments: Optional[List[str]] = None) -> int:
    """Work until the parent process is gone."""
    handle, *modules = sys.argv[1:] if arguments is None else arguments
    # Stopping a service interrupts all its processes; the worker ends with its owner, without a traceback in the log.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(NICENESS)
    for module in modules:
        importlib.import_module(module)
    with Connection(int(handle)) as connection, contextlib.suppress(*GONE):
        connection.send(None)  # Ready: the modules are imported.
        while True:
            _work(connection)
    return 0


def _work(connection: Connection) -> None:
    function, arguments, options = connection.recv()
    try:
        connection.send((function(*arguments, **options), None))
    except GONE:
        raise
    except Exception as error:
        connection.send((None, error))


if __name__ == "__main__":
    sys.exit(main())
