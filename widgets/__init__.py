"""Qt views: one per file, each usable alone; values come down, wishes go up."""
