"""What does not depend on contact: errors, progress, processes, files, numbers, units, names."""
