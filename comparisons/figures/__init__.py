"""Figures of a result: each with its meaning, its uncertainty and its verdict."""
