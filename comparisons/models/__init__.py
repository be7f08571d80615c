"""A scene as a mechanical problem, and its solution by each model on one level."""
