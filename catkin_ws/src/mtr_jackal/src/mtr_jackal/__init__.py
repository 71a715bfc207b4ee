"""Hardware stop of a Jackal, from the status of its base to a stop topic of drive control."""
