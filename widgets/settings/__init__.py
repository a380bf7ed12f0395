"""The pipeline settings as tables."""
