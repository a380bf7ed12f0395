"""The one exception family for what a user can cause and mend."""


class UserError(Exception):
    """Something outside the program is wrong: a file, a text, a device.

    str() is one clear sentence that names the place and the cure. The command line prints it and
    exits with 2, the window shows it as a message; neither ever shows a traceback.
    """
