"""The square of bigrams, and the list of the weak ones."""
