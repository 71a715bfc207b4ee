"""What was heard of the robot, in plain types; the checks read it."""
# SPDX-License-Identifier: Apache-2.0
from collections import Counter
from dataclasses import dataclass, field
from typing import Any, Dict, FrozenSet, List, NamedTuple, Optional, Set, Tuple
from typing import Counter as Count


class ScanContent(NamedTuple):
    """Beams of one scan, how many of them hit something or are no measurement, the time from first to last beam, and
    the widest piece without a measurement in the LiDAR's own view.
    """

    beams: int
    hits: int
    not_numbers: int
    sweep_s: float
    unseen_rad: float = 0.0


class SaidTransform(NamedTuple):
    """parent_from_child as one node said it last: position in m, quaternion as x, y, z, w."""

    position_m: Tuple[float, float, float]
    quaternion: Tuple[float, float, float, float]


@dataclass
class TopicRecord:
    """What came on a topic.

    Attributes:
        type: of its messages by the master; empty when it knows none.
        publishers: names of the nodes that publish it.
        arrivals_s: of the messages, on a clock that nobody sets; in simulation the simulated one.
        ages_s: from a message's stamp to its arrival, on the robot's clock.
        frames: frame of the messages -> how many.
        scans: what was in them, where they are scans.
    """

    type: str = ""
    publishers: Tuple[str, ...] = ()
    arrivals_s: List[float] = field(default_factory=list)
    ages_s: List[float] = field(default_factory=list)
    frames: Count[str] = field(default_factory=Counter)
    scans: List[ScanContent] = field(default_factory=list)


@dataclass
class RobotRecord:
    """All that the standing checks need.

    Attributes:
        topics: by name.
        transforms: (parent, child) -> nodes that published it.
        said: (parent, child, node) -> that transform, as that node said it last.
        listened_s: for so long.
        base: parameters of the base's controller; None: there are none.
        start_failures: node -> why it cannot start.
        nodes: that run, by the master, without the first slash.
        node_parameters: node -> parameters that it has beside the defaults.
        e_stop_topics: on which drive control listens to emergency stops.
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
        """What came on a topic; an empty record when nothing did."""
        return self.topics.get(name, TopicRecord())
