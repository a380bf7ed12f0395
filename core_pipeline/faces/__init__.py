"""Faces: blendshape heads, read from files, deformed by weights, drawn off screen."""
