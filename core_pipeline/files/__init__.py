"""Files: one format, one module; every refusal is one sentence that names file, place and cure."""
