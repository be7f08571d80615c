"""The verdict: within what the half-plane is right, in words, and what to do next."""
