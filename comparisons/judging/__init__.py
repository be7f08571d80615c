"""A model is judged against one that drops its assumptions."""
