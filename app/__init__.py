"""The program: command line, document, session, and the window that joins the widgets."""

import os

# Our matrices are small: more threads of OpenBLAS wait for one another, on cores that the renderer needs.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
