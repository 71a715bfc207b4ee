"""The robot's geometry: everything that a node has to know of its shape, read from its URDF."""
