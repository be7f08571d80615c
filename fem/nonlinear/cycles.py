"""A roller pressed on an elastic-plastic body again and again, or rolled over it, at small strains.

Plastic strain, and with it back stress and flow stress, goes from pass to pass. The roller is
pressed on as in `fem.nonlinear.press_plastic`. Then it may move: at each of a row of places it
bears the same load, and the plastic strain there solves

    ep = return(e(ep)),    e(ep) strain of the elastic bodies in contact with plastic strain ep

with Anderson's acceleration of that iteration (Walker and Ni 2011, SIAM J. Numer. Anal. 49,
1715-1735): no tangent is factored, each iteration takes two back-substitutions. Where it does not
settle, Newton's method does. At the end the roller is lifted.

Nomenclature as of `fem.contact.nonlinear`."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fem.contact.nonlinear import ContactState
from fem.nonlinear.energy import Energies
from fem.nonlinear.newton import RESIDUAL
from fem.nonlinear.press_plastic import LAST_TOUCH, LoadHistory, PlasticContact

# What is left of the iteration: stress of the last change of plastic strain over the yield stress.
# With 1e-8 the plastic strain of a pass changes by less than 1e-5 of itself.
SETTLED = 1e-6
MOST_ITERATIONS = 100  # about 26 are usual
MEMORY = 6  # earlier iterates that Anderson's acceleration combines


@dataclass(frozen=True)
class CyclePass:
    """The roller pressed on, perhaps moved, and lifted."""

    loaded: PlasticContact  # under the load; of a row of places, at the middle one
    released: PlasticContact  # without the roller
    opening: np.ndarray  # (count,) [m] mean gap of `loaded`
    lowering: np.ndarray  # (count,) [m] mean displacement into the body that is left, of all passes
    energies: Energies  # [J/m] of this pass


class Anderson:
    """Anderson's acceleration of an iteration x -> f(x), from a first point."""

    def __init__(self, point: np.ndarray) -> None:
        self.point, self._last = point, None
        self._moves: list[np.ndarray] = []
        self._changes: list[np.ndarray] = []

    def next(self, image: np.ndarray) -> None:
        """Go on from f(`point`), an array of its shape."""
        rest = image - self.point
        if self._last is not None:
            self._moves = [*self._moves, (self.point - self._last[0]).ravel()][-MEMORY:]
            self._changes = [*self._changes, (rest - self._last[1]).ravel()][-MEMORY:]
        self._last, self.point = (self.point, rest), image
        if self._changes:
            changes = np.array(self._changes).T
            share = np.linalg.lstsq(changes, rest.ravel(), rcond=None)[0]
            step = (np.array(self._moves).T + changes) @ share
            self.point = image - step.reshape(rest.shape)


class CycledBody(LoadHistory):
    """The contact from pass to pass; arguments as of `press_plastically`."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)
        self._guess = self.state.pressure

    def press(self, load: float, gaps: Sequence[np.ndarray] = ()) -> CyclePass:
        """Under a load [N/m] and without it, in between at places of weighted gaps (count,) [m^2],
        the first where the roller is pressed on; none: it stays. Raises FemError."""
        before = self._account.now
        self._gap = gaps[0] if len(gaps) else self._gap
        self.state = replace(self.state, pressure=self._guess, approach=0.0, load=0.0)
        self._former = 0.0, self.body.state
        count = self.to(load)
        loaded, opening = self.contact(load, count), self._opening()
        for number, gap in enumerate(gaps[1:], 1):
            self._move(gap)
            if number == len(gaps) // 2:
                loaded, opening = self.contact(load, count), self._opening()
        self.to(LAST_TOUCH * load)
        self.release()
        released = self.contact(0.0, 0)
        lowering = self._compliance.weighted(released.displacement) / self._weights
        return CyclePass(loaded, released, opening, lowering, self._account.now - before)

    def _opening(self) -> np.ndarray:
        """Mean gap (count,) [m] now."""
        state, moved = self.state, self._compliance.weighted(self.state.displacements[0])
        if self._flexible is not None:
            moved = moved + self._flexible @ state.pressure
        return (self._gap + moved) / self._weights - state.approach

    def _move(self, gap: np.ndarray) -> None:
        """To a place of another weighted gap (count,) [m^2], under the same load."""
        self._gap, load = gap, self.state.load
        end = self._settled(load)
        if end is None:
            start = self._frozen(load, self.body.state) or self.state
            self._to_plastic(load, start, RESIDUAL)
        else:
            self._accept(end)

    def _settled(self, load: float) -> ContactState | None:
        """The contact under a load [N/m]; None where the iteration does not settle."""
        body = self.body
        shear, limit = body.metal.elastic.shear_modulus, body.metal.hardening.yield_stress
        mixed = Anderson(body.state.strain)
        for _ in range(MOST_ITERATIONS):
            end = self._frozen(load, replace(body.state, strain=mixed.point))
            if end is None:
                return None
            flowed = body.step(end.displacements[0]).state.strain
            if 2.0 * shear * np.abs(flowed - mixed.point).max() <= SETTLED * limit:
                return end
            mixed.next(flowed)
        return None
