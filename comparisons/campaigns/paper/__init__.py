"""Bailey and Sayles (1991): their figures, and their claims with the numbers that judge them."""
