"""The paper's claims, and the numbers that judge them."""
