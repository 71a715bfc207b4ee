"""Records the arrival of each node's messages, from "ready" until its input ends; then prints one line of JSON.

Times are of the monotonic clock. `tf_age_s` is the age of the transform map to odom at its arrival; its stamp is the
end of the sweep from which it was computed.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import sys
import time
from typing import Any, Dict, List

import rospy
from tf2_msgs.msg import TFMessage

from mtr_core import names

from .arrivals import ASKING, VOICES

PRIORITY = 50


def main() -> int:
    """Record until the input ends; return the exit status."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))
    except PermissionError:
        print("The probe may not have priority: a busy machine's own delays are in its figures.", file=sys.stderr)
    rospy.init_node("arrivals_probe", disable_signals=True)
    callers: Dict[str, Dict[str, List[float]]] = {voice.topic: {} for voice in (*VOICES.values(), *ASKING.values())}
    ages: List[List[float]] = []

    def listen(topic: str) -> rospy.Subscriber:
        def take(message: Any) -> None:
            callers[topic].setdefault(message._connection_header["callerid"], []).append(time.monotonic())
        return rospy.Subscriber(topic, rospy.AnyMsg, take, queue_size=200, tcp_nodelay=True)

    def take_frames(message: Any) -> None:
        for frame in message.transforms:
            if frame.header.frame_id == names.MAP and frame.child_frame_id == names.ODOM:
                ages.append([time.monotonic(), (rospy.Time.now() - frame.header.stamp).to_sec()])

    subscribers = [*map(listen, callers), rospy.Subscriber("/tf", TFMessage, take_frames, queue_size=200,
                                                           tcp_nodelay=True)]
    print("ready", flush=True)
    sys.stdin.read()
    for subscriber in subscribers:
        subscriber.unregister()
    print(json.dumps({"callers": callers, "tf_age_s": ages}), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
