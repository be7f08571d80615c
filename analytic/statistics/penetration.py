"""Relative penetration depth h/R of an asperity: elastic, plastic or cutting (Seireg 1998, 4.8).

    E* combined modulus [Pa]   q0 peak pressure [Pa]   a half-width or radius of a contact [m]
    R  radius of the asperity  h = a^2/R penetration   E = (1 - nu^2) E*, nu = 0.3, the book's

    sphere  a/R = (pi/2) q0/E*:  h/R = (pi/2)^2 (q0/E*)^2 = 2.043 (q0/E)^2; the book prints 1.78,
            with 0.66 for Hertz's 0.616 in q0
    ridge   a/R = 2 q0/E*:       h/R = 4 (q0/E*)^2 = 3.312 (q0/E)^2

In line contact the approach has no datum, a^2/R is twice the depth of the crest below the edges of
contact, as under a sphere. Thresholds of h/R stand for two things. First flow is by stress: a ridge
flows at q0 = 1.7 yield stresses and a sphere at 1.6, so that the elastic limit carries over by q0/E
and with a sphere's coefficient. Cutting is by the slope a/R at the edges, and carries over with a
ridge's."""

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

BOOK_POISSON = 0.3
BOOK_COEFFICIENT = 1.78
SPHERE, RIDGE = 0.25 * np.pi**2, 4.0  # of (q0/E*)^2
ELASTIC = {"ferrous": 1e-2, "nonferrous": 1e-4}
CUTTING = {False: 0.1, True: 0.3}  # dry, lubricated

Metal = Literal["ferrous", "nonferrous"]


def relative_penetration(peak: ArrayLike, modulus: float) -> dict[str, np.ndarray]:
    """h/R at peak pressures [Pa] on E* [Pa]: `book` and `sphere` as printed and exact, `ridge`."""
    square = (np.asarray(peak, dtype=float) / modulus) ** 2
    book = BOOK_COEFFICIENT / (1.0 - BOOK_POISSON**2) ** 2
    return {"book": book * square, "sphere": SPHERE * square, "ridge": RIDGE * square}


def contact_kind(flow: ArrayLike, cut: ArrayLike, metal: Metal, lubricated: bool) -> np.ndarray:
    """elastic, plastic or cutting, by the h/R that decides on flow and the one on cutting."""
    cutting = np.asarray(cut) > CUTTING[lubricated]
    plastic = np.asarray(flow) > ELASTIC[metal]
    return np.where(cutting, "cutting", np.where(plastic, "plastic", "elastic"))
