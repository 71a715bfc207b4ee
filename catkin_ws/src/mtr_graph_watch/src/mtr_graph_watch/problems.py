"""Sentences that the watch of the ROS graph reports to the Operator."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.problems import Sentence

GRAPH_OPEN = Sentence("bringup.graph_open",
                      "The ROS graph is open: {who} is reachable at {address}, allowed is 127.0.0.1 alone; start it "
                      "with: rosrun mtr_graph_watch closed (docs/robot-setup.md).")
GRAPH_UNSEEN = Sentence("bringup.graph_unseen",
                        "Whether the ROS graph is closed was not seen for {age_s:.0f} s, allowed are {limit_s:.0f} s; "
                        "look what holds the ROS master up.")
