"""Surface compliance of half-planes as operators: pressure in, weighted displacement out."""
