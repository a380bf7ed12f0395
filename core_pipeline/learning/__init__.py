"""Animation that is already there → curves and models: corpora, fits, bigrams (section 5.1)."""
