"""Relay of a Jackal's hardware stop, from the status of its base to a stop topic of drive control."""
