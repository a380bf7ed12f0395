"""Users' rigs: files of other programs → faces, and which of their shapes make a pose."""
