"""Publishers of the nodes: the caller itself sends."""
# SPDX-License-Identifier: Apache-2.0
import warnings
from typing import Any

import rospy

from .clock import is_lockstep
from .sending import send_directly

QUEUE = 10


def publisher(topic: str, message_type: Any) -> rospy.Publisher:
    """Publisher of a periodic node, without rospy's thread for each subscriber.

    In lock-step there is no queue either: a subscriber that hangs blocks the caller only when its buffers are full,
    which takes some 20,000 messages. Elsewhere it blocks nobody.
    """
    if is_lockstep():
        return direct_publisher(topic, message_type)
    return send_directly(rospy.Publisher(topic, message_type, queue_size=QUEUE, tcp_nodelay=True), QUEUE)


def direct_publisher(topic: str, message_type: Any, latch: bool = False) -> rospy.Publisher:
    """Publisher without queue: what has been published is on its way, in order with other topics."""
    with warnings.catch_warnings():
        # rospy warns of a missing queue_size, as a slow subscriber then blocks.
        warnings.simplefilter("ignore", SyntaxWarning)
        return rospy.Publisher(topic, message_type, tcp_nodelay=True, latch=latch)
