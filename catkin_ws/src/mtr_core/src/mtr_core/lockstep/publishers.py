"""Publishers of the nodes, which send in the caller's thread."""
# SPDX-License-Identifier: Apache-2.0
import warnings
from typing import Any

import rospy

from .clock import is_lockstep
from .sending import send_directly

QUEUE = 10


def publisher(topic: str, message_type: Any) -> rospy.Publisher:
    """Return the publisher of a periodic node, without rospy's thread for each subscriber.

    In lock-step it has no queue either: a suspended subscriber blocks the caller only when its buffers are full, after
    about 20,000 messages. Otherwise it never blocks.
    """
    if is_lockstep():
        return direct_publisher(topic, message_type)
    return send_directly(rospy.Publisher(topic, message_type, queue_size=QUEUE, tcp_nodelay=True), QUEUE)


def direct_publisher(topic: str, message_type: Any, latch: bool = False) -> rospy.Publisher:
    """Return a publisher without a queue: published messages are sent at once, in order with other topics."""
    with warnings.catch_warnings():
        # rospy warns of a missing queue_size, because a slow subscriber then blocks.
        warnings.simplefilter("ignore", SyntaxWarning)
        return rospy.Publisher(topic, message_type, tcp_nodelay=True, latch=latch)
