"""What a result is: a figure with its meaning, its uncertainty and its verdict."""
