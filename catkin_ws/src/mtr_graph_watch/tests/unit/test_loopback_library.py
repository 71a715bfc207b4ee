"""Preloaded library: TCP on every address becomes loopback, everything else is unchanged."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
import subprocess
import sys

import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2] / "src" / "loopback" / "loopback.cpp"
# Prints the result of getsockname for sockets of (family, type, IPv6 only) bound to an address.
PROGRAM = """
import json, socket, sys
found = []
for family, kind, only, address in json.loads(sys.argv[1]):
    made = socket.socket(getattr(socket, family), getattr(socket, kind))
    if only is not None:
        made.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, only)
    made.bind((address, 0))
    found.append(made.getsockname()[0])
print(json.dumps(found))
"""
CASES = [("AF_INET", "SOCK_STREAM", None, "0.0.0.0", "127.0.0.1"),
         ("AF_INET", "SOCK_STREAM", None, "127.0.0.5", "127.0.0.5"),
         ("AF_INET", "SOCK_DGRAM", None, "0.0.0.0", "0.0.0.0")]
CASES6 = [("AF_INET6", "SOCK_STREAM", 1, "::", "::1"), ("AF_INET6", "SOCK_STREAM", 0, "::", "::ffff:127.0.0.1")]


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """Return the compiled library."""
    path = tmp_path_factory.mktemp("library") / "libmtr_loopback.so"
    subprocess.run(["g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-o", str(path),
                    str(SOURCE)], check=True)
    return path


def bound(cases, preload):
    """Return the addresses of bound sockets with the library, or without it."""
    done = subprocess.run([sys.executable, "-c", PROGRAM, json.dumps([case[:4] for case in cases])], text=True,
                          env=dict(os.environ, LD_PRELOAD=preload), capture_output=True, check=True)
    assert done.stderr == ""
    return json.loads(done.stdout)


def test_sockets_on_every_address_are_on_loopback(library):
    assert bound(CASES, "")[0] == "0.0.0.0"
    assert bound(CASES, str(library)) == [case[-1] for case in CASES]


@pytest.mark.skipif(not pathlib.Path("/proc/net/if_inet6").exists(), reason="This kernel has no IPv6.")
def test_sockets_of_ipv6_serve_those_whom_they_served(library):
    assert bound(CASES6, str(library)) == [case[-1] for case in CASES6]
