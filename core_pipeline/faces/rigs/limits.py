"""How large a face may be; asked before memory is taken for it."""

#: Bytes of one file.
MAX_FILE = 512 * 2**20
#: Bytes of one .obj, and of the description (JSON) of a glTF: as text, a mesh takes several times its size while read.
MAX_TEXT = 128 * 2**20
#: Bytes that the compressed views of a file may unpack to, all together.
MAX_UNPACKED = 256 * 2**20
MAX_VERTICES = 2_000_000
MAX_TRIANGLES = 3_000_000
#: Bytes of all shapes, positions and normals together: vertices × shapes × 24.
MAX_MORPH_BYTES = 2**29
#: Coordinates beyond this are damage, or a unit nobody models in.
LARGEST = 1e6
