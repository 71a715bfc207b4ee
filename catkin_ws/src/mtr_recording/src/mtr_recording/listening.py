"""Checks that a recorder is connected to all its topics: earlier messages are not recorded."""
# SPDX-License-Identifier: Apache-2.0
import http.client
import xmlrpc.client
from typing import Any, Dict, List

import rosgraph

# Possible errors of a call to a node that is just starting, or has just ended.
CALL_ERRORS = (OSError, xmlrpc.client.Error, http.client.HTTPException, rosgraph.MasterError)
_CALLER = "/mtr_recording"


def is_listening(recorder: str) -> bool:
    """Return True if the node is connected to every publisher of its subscribed topics, and at least to one."""
    master = rosgraph.Master(_CALLER)
    try:
        published, subscribed, _ = master.getSystemState()
        heard: Dict[str, List[str]] = dict(subscribed)
        expected = sum(len(nodes) for topic, nodes in published if recorder in heard.get(topic, []))
        if not expected:
            return False
        api: Any = xmlrpc.client.ServerProxy(master.lookupNode(recorder))
        return expected <= sum(direction == "i" for _, _, direction, *_ in api.getBusInfo(_CALLER)[2])
    except CALL_ERRORS:
        return False
