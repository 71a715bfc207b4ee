"""A browser's side of the pages of tests that are being measured: requests, and the events of one test."""
# SPDX-License-Identifier: Apache-2.0
import http.client
import json
import re
import time

PATIENCE_S = 20.0


class Browser:
    """Follows the events of one test; what is shown is in parts, as in the page."""

    def __init__(self, port, name, **headers):
        self._connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S)
        self._connection.request("GET", f"/live/{name}/events", headers={"Host": f"127.0.0.1:{port}", **headers})
        self.answer = self._connection.getresponse()
        self.parts, self.events = {}, []

    def see(self, text):
        """Take events until a text is shown; times out when it is not."""
        until_s = time.monotonic() + PATIENCE_S
        while text not in "".join(self.parts.values()):
            assert time.monotonic() < until_s, f"{text} is not shown"
            line = self.answer.readline()
            assert line, "the server has ended the connection"
            if line.startswith(b"data: "):
                self.events.append(json.loads(line[6:]))
                self.parts.update(self.events[-1])
        return self

    def close(self):
        """As a window that is closed."""
        self.answer.close()
        self._connection.close()


def ask(port, path, **headers):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S)
    connection.request("GET", path, headers={"Host": f"127.0.0.1:{port}", **headers})
    answer = connection.getresponse()
    return answer.status, answer.read().decode(), answer.headers


def only_name(port):
    name, = set(re.findall(r'href="/live/(\w+)"', ask(port, "/live")[1]))
    return name
