"""Measured profiles from the files of any program or instrument."""
