"""Loss of a controller that its driver does not notice, by reports that the controller sends even while it is idle."""
