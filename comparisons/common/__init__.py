"""What knows nothing of contact: errors, progress, processes, files, numbers, units, names."""
