"""Layers on rigid bases and coatings on half-planes: their compliance and their stresses."""
