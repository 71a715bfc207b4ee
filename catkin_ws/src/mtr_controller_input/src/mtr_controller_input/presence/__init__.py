"""Detects the loss of a controller, if its driver does not, from the reports that it also sends while idle."""
