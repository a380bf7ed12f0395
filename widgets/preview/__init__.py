"""The face, the weights that move it, and how its poses are mixed."""
