"""The curve canvas and what stands around it: the open bigram under the hand."""
