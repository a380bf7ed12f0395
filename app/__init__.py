"""The program: command line, document, session, and the window that joins the widgets."""
