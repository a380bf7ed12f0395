"""How large a face may be; asked before memory is taken for it."""

#: Bytes of one file.
MAX_FILE = 512 * 2**20
MAX_VERTICES = 2_000_000
#: Bytes of all shapes, positions and normals together: vertices × shapes × 24.
MAX_MORPH_BYTES = 2**30
#: Coordinates beyond this are damage, or a unit nobody models in.
LARGEST = 1e6
