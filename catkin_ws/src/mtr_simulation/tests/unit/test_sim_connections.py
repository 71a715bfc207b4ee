"""Connections between nodes that a simulation waits for before its clock starts."""
# SPDX-License-Identifier: Apache-2.0
from mtr_simulation.clock import connections

STATE = [[["/scan", ["/sim"]], ["/rosout", ["/sim", "/a"]]], [["/scan", ["/a", "/sim"]], ["/rosout", ["/log"]],
                                                              ["/nobody", ["/a"]]], []]


def test_wanted_connections_join_publishers_and_other_subscribers():
    assert connections.wanted(STATE) == {connections.Connection("/scan", "/sim", "/a")}


def test_outgoing_connections_are_read_from_bus_info():
    info = [[1, "/a", "o", "TCPROS", "/scan", True, "..."], [2, "http://host:1/", "i", "TCPROS", "/hold", True, "..."]]
    assert connections.outgoing("/sim", info) == {connections.Connection("/scan", "/sim", "/a")}


def test_missing_connections_are_named():
    text = connections.sentence([connections.Connection("/scan", "/sim", "/a")])
    assert text == "/scan from /sim to /a"
