"""The environment in which a program of the ROS graph listens on loopback only. Pure."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, Mapping, MutableMapping
from urllib.parse import urlparse

from .listening_sockets import is_loopback

LOOPBACK = "127.0.0.1"
# Library of src/loopback, found by LD_LIBRARY_PATH, which a workspace's setup.bash sets.
LIBRARY = "libmtr_loopback.so"


def closed_environment(environment: Mapping[str, str]) -> Dict[str, str]:
    """Return this environment on loopback, without ROS_HOSTNAME, which has priority over ROS_IP."""
    kept = {name: value for name, value in environment.items() if name != "ROS_HOSTNAME"}
    return {"ROS_MASTER_URI": f"http://{LOOPBACK}:11311", **kept, "ROS_IP": LOOPBACK, "LD_PRELOAD": LIBRARY}


def as_around(environment: Mapping[str, str]) -> Dict[str, str]:
    """Return the closed environment if the graph is on loopback; the same one in a graph opened by choice."""
    on_loopback = environment.get("ROS_IP", "").startswith("127.")
    return closed_environment(environment) if on_loopback else dict(environment)


def join_on_loopback(environment: MutableMapping[str, str]) -> None:
    """Make a Python program that joins a graph on loopback listen there too, unless a person chose its address.

    By default it would listen on every address, and the graph watch would stop the robot.
    """
    host = urlparse(environment.get("ROS_MASTER_URI", "")).hostname or ""
    if is_loopback(host) and not environment.get("ROS_IP") and not environment.get("ROS_HOSTNAME"):
        environment["ROS_IP"] = LOOPBACK
