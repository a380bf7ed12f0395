"""Faces → pixels."""
