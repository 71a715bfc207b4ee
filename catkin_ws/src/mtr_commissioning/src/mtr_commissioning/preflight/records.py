"""Received data of the robot as plain types for the checks."""
# SPDX-License-Identifier: Apache-2.0
from collections import Counter
from dataclasses import dataclass, field
from typing import Any, Dict, FrozenSet, List, NamedTuple, Optional, Set, Tuple
from typing import Counter as Count


class ScanContent(NamedTuple):
    """Numbers of beams, of hits and of beams without a measurement in one scan, the time from first to last beam, and
    the widest sector without a measurement in the LiDAR's own view."""

    beams: int
    hits: int
    not_numbers: int
    sweep_s: float
    unseen_rad: float = 0.0


class SaidTransform(NamedTuple):
    """Latest parent_from_child of one node: position in m, quaternion as x, y, z, w."""

    position_m: Tuple[float, float, float]
    quaternion: Tuple[float, float, float, float]


@dataclass
class TopicRecord:
    """Received messages of a topic.

    Attributes:
        type: of its messages by the master; empty if unknown.
        publishers: names of the nodes that publish it.
        arrivals_s: of the messages, on a steady clock; in simulation the simulated one.
        ages_s: from a message's stamp to its arrival, on the robot's clock.
        frames: frame of the messages -> number.
        scans: contents, if they are scans.
    """

    type: str = ""
    publishers: Tuple[str, ...] = ()
    arrivals_s: List[float] = field(default_factory=list)
    ages_s: List[float] = field(default_factory=list)
    frames: Count[str] = field(default_factory=Counter)
    scans: List[ScanContent] = field(default_factory=list)


@dataclass
class RobotRecord:
    """Data for all standing checks.

    Attributes:
        topics: by name.
        transforms: (parent, child) -> nodes that published it.
        said: (parent, child, node) -> that node's latest transform.
        listened_s: duration of the recording.
        base: parameters of the base's controller; None without any.
        start_failures: node -> why it cannot start.
        nodes: running ones, by the master, without the first slash.
        node_parameters: node -> parameters in addition to the defaults.
        e_stop_topics: drive control's topics of emergency stops.
    """

    topics: Dict[str, TopicRecord] = field(default_factory=dict)
    transforms: Dict[Tuple[str, str], Set[str]] = field(default_factory=dict)
    said: Dict[Tuple[str, str, str], SaidTransform] = field(default_factory=dict)
    listened_s: float = 0.0
    base: Optional[Dict[str, Any]] = None
    start_failures: Dict[str, str] = field(default_factory=dict)
    nodes: FrozenSet[str] = frozenset()
    node_parameters: Dict[str, Any] = field(default_factory=dict)
    e_stop_topics: Tuple[str, ...] = ()

    def topic(self, name: str) -> TopicRecord:
        """Return the messages of a topic; an empty record without any."""
        return self.topics.get(name, TopicRecord())
