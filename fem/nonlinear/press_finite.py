"""A roller pressed on a body that flows at finite strains, released, and pressed again.

As `fem.nonlinear.press_plastic`, without linearisation: the body is a
`fem.nonlinear.finite_plasticity.FinitePlasticBody`, an elastic roller follows its own law at finite
strains, and contact and friction are on the deformed surfaces (`FiniteContact` of
`fem.nonlinear.finite_deformation`, which also says why bodies are moved back along x). The loads
are reached by the same increments. Each starts from the last contact, changed as that of small
strains on the linear compliances changes.

Nomenclature as of `fem.contact.nonlinear`."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fem.contact.deformed_roller import TwoBodies
from fem.contact.nonlinear import ContactState, NonlinearSolution
from fem.nonlinear.finite_deformation import FiniteContact, FiniteDeformation
from fem.nonlinear.finite_plasticity import FinitePlasticBody
from fem.nonlinear.newton import RESIDUAL, newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic, PlasticState
from fem.nonlinear.press_plastic import TRAVEL, LoadHistory, PlasticContact, unloaded
from fem.solver.mumps import FemError

# Mean slip of the surfaces that is left, of a hat: under a load, and on the way there.
ASIDE, ASIDE_ON_THE_WAY = 1e-3, 0.05
MOST_SETTINGS = 6


@dataclass(frozen=True)
class FinitePlasticContact(PlasticContact):
    """As `PlasticContact`. The pressure is the vertical force per undeformed length of x, and the
    plastic strain logarithmic, in the axes of the undeformed body."""

    deformed: FiniteDeformation  # places, stretches, Cauchy's pressure and gap; not its stresses


def press_plastically_finitely(
    contact: FiniteContact, metal: ElasticPlastic, loads: Sequence[float], travel: float = TRAVEL
) -> tuple[FinitePlasticBody, tuple[FinitePlasticContact, ...]]:
    """The body at the end, and the contact under each of the loads in turn.

    contact  body and roller, undeformed, with the linear pressure under the first load; the body's
             material is the metal's elastic one, whose law is not asked for: it is Hencky's
    metal    of the body; the roller, where it is elastic, stays so
    loads    P [N/m] of the pressures, without what friction bears, the first positive; 0 removes
             the roller
    travel   hats that an edge of the contact may travel in one increment

    Stresses and plastic strain at the mesh's points, which move by `displacement`, are
    `fem.nonlinear.press_plastic.plastic_fields` of the two results; they are Cauchy's. Raises
    ValueError for negative loads, FemError if a load cannot be reached."""
    way = _FiniteHistory(contact, metal, travel)
    return way.body, way.through(loads)


@dataclass(frozen=True)
class _Start(ContactState):
    aside: np.ndarray | float = 0.0  # by which all bodies' nodes (n, 2) [m] are moved back


class _FiniteHistory(LoadHistory):
    """The contact from load to load. The linear compliances lead ahead: gap and displacements are
    what the last contact had, and the linear change since then."""

    kind = FinitePlasticBody

    def __init__(self, contact: FiniteContact, metal: ElasticPlastic, travel: float) -> None:
        roller = contact.roller if len(contact.elastic) > 1 else None
        start, gap, friction = contact.start, contact.gap, contact.friction
        super().__init__(
            contact.compliance, metal, gap, contact.weights, start, friction, roller, travel
        )
        self._contact, self._opposite = contact, roller
        response = self.body
        if roller is not None:
            moduli = tuple(body.material.youngs_modulus for body in contact.elastic)
            response = TwoBodies(self.body, contact.response.parts[1], moduli)
        self._response, self._bodies = response, [(response, contact.contact)]
        self._beyond = np.zeros_like(contact.linear)  # displacements that are not linear
        self.state = _Start((np.zeros_like(contact.linear),), start, approach=0.0)

    def contact(self, load: float, iterations: int) -> FinitePlasticContact:
        common = dict(vars(super().contact(load, iterations)))
        both, weights = self.state.displacements, self._weights
        common["displacement"] = both[0][: len(self.body.held)]
        opening = self._contact.contact.loaded(both[0], self.state.pressure)[0] / weights
        state = replace(self.state, pressure=common["pressure"])
        solution = NonlinearSolution(state, opening - self.state.approach, (), 0)
        return FinitePlasticContact(**common, deformed=self._contact.deformed(solution))

    def release(self) -> None:
        """Without the roller: from the last touch, unloaded elastically."""
        both, state = self.state.displacements[0], self.state
        own, other = np.split(both, [len(self.body.held)])
        linear = self._contact.compliance.displacement(state.pressure, self._friction)
        scale = np.abs(self._contact.contact.loaded(both, state.pressure)[1]).max()
        free = unloaded(self.body, own - linear, scale)
        self.state = replace(state, displacements=(np.vstack([free, other]),))

    def _to_elastic(self, load: float) -> bool:
        """Whether nothing flows up to a load [N/m], and then that load."""
        start = self._frozen(load, self.body.state)
        if start is None or self._flows(start):
            return False
        try:
            end, _ = self._settled(load, start, RESIDUAL, ASIDE)
        except FemError:
            return False
        if self._flows(end):
            return False
        self._accept(end)
        return True

    def _flows(self, state: ContactState) -> bool:
        own = state.displacements[0][: len(self.body.held)]
        return bool(self.body.step(own).yields.any())

    def _to_plastic(self, load: float, start: ContactState, residual: float) -> int:
        aside = ASIDE if residual == RESIDUAL else ASIDE_ON_THE_WAY
        end, contacts = self._settled(load, start, residual, aside)
        self._accept(end)
        return contacts

    def _settled(
        self, load: float, start: "_Start", residual: float, aside: float
    ) -> tuple["_Start", int]:
        """The contact under a load [N/m], where no surface slips aside in the mean by more than a
        part of a hat, and the linear contacts to get there."""
        contacts = 0
        for _ in range(MOST_SETTINGS):
            end, residuals = newton_by_contacts(
                *(self._bodies, np.zeros_like(self._gap), self._weights, start, load),
                residual=residual,
                factor=self._factor,
            )
            contacts += len(residuals)
            end = _Start(end.displacements, end.pressure, end.approach, end.load, start.aside)
            start, off = self._set_back(end)
            if off <= aside * self._weights.mean():
                break
        return end, contacts

    def _set_back(self, state: "_Start") -> tuple["_Start", float]:
        """The state with each body moved back along x, and by how much at most [m]."""
        [moved] = state.displacements
        back, off = self._contact.set_back(moved, state.pressure)
        return replace(state, displacements=(back,), aside=state.aside + back - moved), off

    def _linear(self, pressure: np.ndarray, plastic: PlasticState) -> np.ndarray:
        """Displacement (n, 2) [m] of all nodes at small strains, held ones included."""
        own = self._contact.compliance.displacement(pressure, self._friction)
        own = own + self.body.body.solve(self.body.plastic_force(plastic))
        if self._opposite is None:
            return own
        return np.vstack([own, self._opposite.displacement(pressure, -self._friction)])

    def _frozen(self, load: float, plastic: PlasticState) -> "_Start | None":
        linear = super()._frozen(load, plastic)
        if linear is None:
            return None
        moved = self._linear(linear.pressure, plastic)
        moved = moved + np.where(self._response.held, 0.0, self._beyond)
        start, _ = self._set_back(replace(self.state, displacements=(moved,), aside=0.0))
        return replace(start, pressure=linear.pressure, approach=linear.approach, load=load)

    def _accept(self, found: "_Start") -> None:
        self._former = self.state.load, self.body.state
        self._response.accept(found.displacements[0])
        self.state = found
        linear = self._linear(found.pressure, self.body.state)
        self._beyond = found.displacements[0] - found.aside - linear
        gap, _ = self._contact.contact.loaded(found.displacements[0], found.pressure)
        self._gap = gap - self._elastic.flexible @ found.pressure
        flowed = self.body.body.solve(self.body.plastic_force(self.body.state))
        self._gap -= self._contact.compliance.weighted(flowed)
