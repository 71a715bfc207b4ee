"""Checks that every transform comes from a single node."""
# SPDX-License-Identifier: Apache-2.0
from typing import Dict, List, Set, Tuple

from mtr_core import names
from mtr_motion_check.finding import Finding, bad, good

CHECK = "tf.publishers"
REMEDIES = {
    (names.ODOM, names.BASE): "let localization leave it to the base (its parameter publish_odom_tf false), or switch "
                              "it off in the base (enable_odom_tf false)",
    (names.MAP, names.ODOM): "end the other SLAM, or start the robot with localization:=external",
}


def transform_findings(transforms: Dict[Tuple[str, str], Set[str]]) -> List[Finding]:
    """Report transforms that two nodes publish, and frames with two parents."""
    found = [several_nodes(pair, nodes) for pair, nodes in sorted(transforms.items()) if len(nodes) > 1]
    children = sorted({child for _, child in transforms})
    for child in children:
        parents = sorted(parent for parent, other in transforms if other == child)
        if len(parents) > 1:
            nodes = sorted(set().union(*(transforms[(parent, child)] for parent in parents)))
            found.append(bad(CHECK, child, f"It hangs on {len(parents)} frames ({', '.join(parents)}; from "
                             f"{', '.join(nodes)}), allowed is 1: let one of them publish nothing.", len(parents), 1))
    return found or [good(CHECK, "/tf", f"{len(transforms)} transforms, each from one node.", len(transforms))]


def several_nodes(pair: Tuple[str, str], nodes: Set[str]) -> Finding:
    """Report two nodes that publish the same transform."""
    remedy = REMEDIES.get(pair, "let all but one of them publish elsewhere")
    return bad(CHECK, f"{pair[0]} -> {pair[1]}", f"{len(nodes)} nodes publish it ({', '.join(sorted(nodes))}), allowed "
               f"is 1: {remedy}.", len(nodes), 1)
