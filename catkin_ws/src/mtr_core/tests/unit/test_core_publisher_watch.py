"""Permission to publish on a topic that must have one publisher."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_core import names
from mtr_core.lockstep import ANY_NODE
from mtr_core.lockstep.publisher_watch import Intruder, SolePublishers

TOPIC = "/joy"


def watched(permitted, *updates):
    """Return the watch after these lists of publishers of TOPIC."""
    sole = SolePublishers({TOPIC: permitted})
    for nodes in updates:
        sole.update([("/other", ["/a", "/b"]), (TOPIC, nodes)] if nodes else [])
    return sole


@pytest.mark.parametrize("permitted", [ANY_NODE, "/driver"])
@pytest.mark.parametrize("updates", [[], [[]], [["/driver"]], [[], ["/driver"], []], [["/driver"], ["/driver"]]])
def test_no_publisher_and_the_only_one_are_no_intruders(permitted, updates):
    assert watched(permitted, *updates).intruder is None


@pytest.mark.parametrize("permitted, updates, node", [
    (ANY_NODE, [["/driver"], ["/play_1", "/driver"]], "/play_1"),
    (ANY_NODE, [["/driver"], ["/driver", "/zz"]], "/zz"),
    (ANY_NODE, [["/driver", "/play_1"]], "/driver and /play_1"),
    (ANY_NODE, [["/driver"], ["/a", "/b"]], "/a and /b"),
    ("/driver", [["/play_1"]], "/play_1"), ("/driver", [["/driver", "/play_1"]], "/play_1"),
    ("/driver", [["/driver", "/b", "/a"]], "/a and /b")])
def test_second_publisher_is_named(permitted, updates, node):
    assert watched(permitted, *updates).intruder == Intruder(node, TOPIC)


@pytest.mark.parametrize("permitted", [ANY_NODE, "/driver"])
def test_intruder_that_has_ended_is_forgotten(permitted):
    assert watched(permitted, ["/driver"], ["/driver", "/play_1"], ["/driver"]).intruder is None


def test_another_driver_may_replace_one_that_has_ended_unless_the_driver_is_given():
    assert watched(ANY_NODE, ["/driver"], [], ["/pad"]).intruder is None
    assert watched(ANY_NODE, ["/driver"], ["/pad"]).intruder is None
    assert watched("/driver", ["/driver"], ["/pad"]).intruder == Intruder("/pad", TOPIC)


@pytest.mark.parametrize("permitted, updates, permits", [
    # Before the master's first answer the publishers are unknown.
    (ANY_NODE, [], True), (ANY_NODE, [["/driver"]], True), (ANY_NODE, [["/driver"], ["/driver", "/play_1"]], False),
    # A node that appeared since the last answer could be a second publisher.
    (ANY_NODE, [["/play_1"]], False), (ANY_NODE, [[]], False),
    ("/driver", [], True), ("/driver", [[]], True), ("/driver", [["/play_1"]], True)])
def test_message_is_used_only_of_the_sole_publisher(permitted, updates, permits):
    assert watched(permitted, *updates).permits(TOPIC, "/driver") is permits


def test_message_of_another_node_than_the_given_driver_is_never_used():
    assert not watched("/driver").permits(TOPIC, "/play_1")


def test_every_order_has_its_watch():
    topics = {name: value for name, value in vars(names).items() if name.isupper() and str(value).startswith("/")}
    orders = {value for name, value in topics.items()
              if name.startswith("FIRMWARE_") or "/command/" in value or name.endswith("_MODE")}
    reports = {names.FIRMWARE_STATE, names.FIRMWARE_ECHO, names.FIRMWARE_HEALTH, names.FIRMWARE_INPUTS}
    assert orders - reports <= set(names.MOTION_INPUTS) and names.DESIRED_STATE in names.MOTION_INPUTS
