"""End of this process's part in the graph of nodes."""
# SPDX-License-Identifier: Apache-2.0
import contextlib

import rospy


def shut_down(reason: str) -> None:
    """As rospy.signal_shutdown does it."""
    # The rospy of Debian 11 then asks its threads for what those of Python 3.9 no longer have.
    with contextlib.suppress(AttributeError):
        rospy.signal_shutdown(reason)
