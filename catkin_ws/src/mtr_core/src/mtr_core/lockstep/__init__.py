"""Common parts of the nodes: their start, ticks that a simulated clock waits for, and inputs that are due at a tick."""
# SPDX-License-Identifier: Apache-2.0
from .inputs import TickInput
from .publisher_watch import ANY_NODE, PublisherWatch
from .publishers import direct_publisher, publisher
from .stamped_queue import StampedQueue
from .start import run_node
from .ticker import Ticker

__all__ = ["ANY_NODE", "PublisherWatch", "StampedQueue", "TickInput", "Ticker", "direct_publisher", "publisher",
           "run_node"]
