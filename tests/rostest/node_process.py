"""A node as a child process, for tests that need it fresh, slow or dead."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import signal
import subprocess
from types import MappingProxyType
from typing import Any, Mapping

import roslib.packages

STOP_LIMIT_S = 10.0
END_LIMIT_S = 60.0


class NodeProcess:
    """One run of a node; parameters are private ones."""

    def __init__(self, package: str, executable: str, name: str, remaps: Mapping[str, str] = MappingProxyType({}),
                 variables: Mapping[str, str] = MappingProxyType({}), **parameters: Any):
        """remaps: topics by other names. variables: further ones of its environment."""
        path = roslib.packages.find_node(package, executable)[0]
        # Of C++ nodes a quoted text would keep its quotes.
        values = [f"_{key}:={value if isinstance(value, str) else json.dumps(value)}"
                  for key, value in parameters.items()]
        others = [f"{old}:={new}" for old, new in remaps.items()]
        self._process = subprocess.Popen([path, f"__name:={name}", *others, *values], stdout=subprocess.PIPE, text=True,
                                         env={**os.environ, **variables})

    def signal(self, number: int) -> None:
        """Send it a signal."""
        self._process.send_signal(number)

    def output(self) -> str:
        """What it has printed, when it ends by itself."""
        return self._process.communicate(timeout=END_LIMIT_S)[0]

    def exit_status(self) -> int:
        """How it has ended by itself."""
        self.output()
        return self._process.returncode

    def stop(self) -> None:
        """End it as Ctrl-C does, and when it hangs by force."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
            try:
                self._process.communicate(timeout=STOP_LIMIT_S)
            except subprocess.TimeoutExpired:
                self._process.kill()
        self._process.communicate()
