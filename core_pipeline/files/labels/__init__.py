"""Label files of other programs: phones and words with times. `read.py` finds out the format from the content."""
