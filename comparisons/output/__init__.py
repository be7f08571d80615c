"""Files and numbers of a finished run."""
