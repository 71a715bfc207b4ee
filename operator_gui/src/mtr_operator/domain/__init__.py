"""Decisions of the Operator's application: pure Python, no Qt, sockets or CAN."""
