"""Parameters of the dispatcher that runs on this robot, for the commands `pair` and `keys`."""
# SPDX-License-Identifier: Apache-2.0
import os
import socket
import xmlrpc.client
from typing import Any, Dict

CALLER, NAME = "/mtr_link_commands", "/dispatcher"
MASTER_PORT = 11311
PATIENCE_S = 2.0


def parameters() -> Dict[str, Any]:
    """Return the dispatcher's parameters, or none without a ROS master, because both commands also work without it."""
    uri = os.environ.get("ROS_MASTER_URI") or f"http://127.0.0.1:{MASTER_PORT}"
    before = socket.getdefaulttimeout()
    socket.setdefaulttimeout(PATIENCE_S)
    try:
        code, _, found = xmlrpc.client.ServerProxy(uri).getParam(CALLER, NAME)  # type: ignore[misc]
    except (OSError, xmlrpc.client.Error, ValueError, TypeError):
        return {}
    finally:
        socket.setdefaulttimeout(before)
    return found if code == 1 and isinstance(found, dict) else {}
