"""Code that knows no contact: errors, progress, processes, files, numbers, units, names."""
