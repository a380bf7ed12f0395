"""Ways to turn a schedule into weights: ours, and those of the papers that ours is compared with."""
