"""A roller pressed on an elastic-plastic body again and again, or rolled over it, at small strains.

Plastic strain, and with it back stress and flow stress, goes from pass to pass. The roller is
pressed on as in `fem.nonlinear.press_plastic`. Then it may move: at each of a row of places it
bears the same load, and the plastic strain there solves

    ep = return(e(ep)),    e(ep) strain of the elastic bodies in contact with plastic strain ep

with Anderson's acceleration of that iteration (Walker and Ni 2011, SIAM J. Numer. Anal. 49,
1715-1735): no tangent is factored, each iteration takes two back-substitutions. Where it does not
settle, Newton's method does. At the end the roller is lifted.

Work is that of the contact on the body. Where nothing flows the body stores it all. Of an increment
with flow it is the mean load times the change of the approach, less the mean pressures on what the
roller's shape and place change of the gap, and with friction the tractions on what they move.

Nomenclature as of `fem.contact.nonlinear`."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fem.contact.nonlinear import ContactState
from fem.nonlinear.newton import RESIDUAL
from fem.nonlinear.plasticity import PlasticState
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
    work: float  # of the contact on the body [J/m]
    plastic_work: float  # [J/m] dissipated, or stored in hardening
    stored: float  # [J/m] change of the elastic energy of the body that is left


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
        self._guess, self._place = self.state.pressure, self._gap
        self._work = self._plastic_work = 0.0
        self._stresses = self._measured()

    def press(self, load: float, gaps: Sequence[np.ndarray] = ()) -> CyclePass:
        """Under a load [N/m] and without it, in between at places of weighted gaps (count,) [m^2],
        the first where the roller is pressed on; none: it stays. Raises FemError."""
        work, plastic_work, stored = self._work, self._plastic_work, self._energy()
        self._gap = self._place = gaps[0] if len(gaps) else self._gap
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
        work, plastic_work = self._work - work, self._plastic_work - plastic_work
        stored = self._energy() - stored
        released = self.contact(0.0, 0)
        lowering = self._compliance.weighted(released.displacement) / self._weights
        return CyclePass(loaded, released, opening, lowering, work, plastic_work, stored)

    def _opening(self) -> np.ndarray:
        """Mean gap (count,) [m] now."""
        state, moved = self.state, self._compliance.weighted(self.state.displacements[0])
        if self._flexible is not None:
            moved = moved + self._flexible @ state.pressure
        return (self._gap + moved) / self._weights - state.approach

    def release(self) -> None:
        """Without the roller."""
        before, flowed = self.state, self.body.state
        super().release()
        self._add_work(
            before, flowed, replace(self.state, pressure=0.0 * before.pressure, load=0.0)
        )

    def _accept(self, state: ContactState) -> None:
        before, flowed = self.state, self.body.state
        super()._accept(state)
        self._add_work(before, flowed, state)

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

    def _measured(self) -> tuple[np.ndarray, np.ndarray]:
        """Stresses sx, sz, txz, sy [Pa] and elastic strains exx, ezz, gxz, eyy (3m, 4) now."""
        moved, state = self.state.displacements[0], self.body.state
        stress = np.column_stack(self.body.stress(moved, state))
        inside = np.column_stack([self.body.strain(moved), np.zeros(len(stress))])
        return stress, inside - plastic_parts(state)

    def _energy(self) -> float:
        """Elastic energy of the body [J/m]."""
        stress, strain = self._stresses
        return 0.5 * float(self.body.areas.ravel() @ (stress * strain).sum(axis=1))

    def _add_work(self, before: ContactState, flowed: PlasticState, now: ContactState) -> None:
        """Of the step from a contact with a plastic state to that of now."""
        energy, (stress, _) = self._energy(), self._stresses
        self._stresses = self._measured()
        moved, self._place = self._gap - self._place, self._gap
        if np.array_equal(self.body.state.equivalent, flowed.equivalent):
            self._work += self._energy() - energy
            return
        flow = plastic_parts(self.body.state) - plastic_parts(flowed)
        mean = 0.5 * (stress + self._stresses[0])
        self._plastic_work += float(self.body.areas.ravel() @ (mean * flow).sum(axis=1))
        first = before.pressure if before.load else np.zeros_like(moved)
        pressure = 0.5 * (first + now.pressure)
        change = now.displacements[0] - before.displacements[0]
        if before.load and now.load:
            risen = self._weights * (now.approach - before.approach) - moved
            if self._flexible is not None:
                risen = risen - self._flexible @ (now.pressure - first)
        else:
            risen = self._compliance.weighted(change)
        self._work += float(pressure @ risen)
        if self._friction:
            top = change[self._compliance.body.surface.point].ravel()
            along = self._compliance.tangential @ pressure
            self._work += self._friction * float(along @ top)


def plastic_parts(state: PlasticState) -> np.ndarray:
    """Plastic exx, ezz, gxz, eyy (k, 4) of a state."""
    xx, zz, xz = state.strain.T
    return np.column_stack([xx, zz, 2.0 * xz, -xx - zz])


def equivalent_of(parts: np.ndarray) -> np.ndarray:
    """Equivalent strain (k,) of plastic exx, ezz, gxz, eyy (k, 4)."""
    return np.sqrt(2.0 / 3.0 * (parts**2 @ [1.0, 1.0, 0.5, 1.0]))
