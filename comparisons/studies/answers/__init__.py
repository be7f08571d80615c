"""Answers from outside: any code's pressures and stresses, or measured ones, beside the models'."""
