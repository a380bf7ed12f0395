"""Nothing is ever lost: the journal of edits, backups, locks, and what other programs do to an open file."""
