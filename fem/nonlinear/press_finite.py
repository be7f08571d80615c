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
from fem.nonlinear.finite_deformation import MOST_SETTINGS, FiniteContact, FiniteDeformation
from fem.nonlinear.finite_plasticity import FinitePlasticBody
from fem.nonlinear.newton import RESIDUAL, newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic, PlasticState
from fem.nonlinear.press_plastic import TRAVEL, LoadHistory, PlasticContact, unloaded

# On the way to a load surfaces may slip and friction bear so many times more than under it.
LOOSER = 50.0


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
    loads    P [N/m] vertical force of pressures and their friction, the first positive; 0 removes
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
        self.state = self._last = _Start((np.zeros_like(contact.linear),), start, approach=0.0)

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
        displacement, other = np.split(both, [len(self.body.held)])
        linear = self._contact.compliance.displacement(state.pressure, self._friction)
        scale = np.abs(self._contact.contact.loaded(both, state.pressure)[1]).max()
        free = unloaded(self.body, displacement - linear, scale)
        self.state = replace(state, displacements=(np.vstack([free, other]),))
        self._book(np.zeros_like(state.pressure))

    def _solved(
        self,
        start: "_Start",
        load: float | None,
        approach: float | None = None,
        residual: float = RESIDUAL,
    ) -> tuple["_Start", int]:
        """As of small strains, `FiniteContact.settled`."""
        contact, looser = self._contact, 1.0 if residual == RESIDUAL else LOOSER
        contacts, asked = 0, load and contact.pressing(load, *start.displacements, start.pressure)
        for _ in range(MOST_SETTINGS):
            end, residuals = newton_by_contacts(
                *(self._bodies, np.zeros_like(self._gap), self._weights, start, asked, approach),
                residual=residual,
            )
            contacts += len(residuals)
            borne = load or contact.borne(*end.displacements, end.pressure)
            end = _Start(end.displacements, end.pressure, end.approach, borne, start.aside)
            moved, asked, is_settled = contact.settled(end, load, asked, looser)
            if is_settled:
                break
            start = self._set_back(end, moved)
        return end, contacts

    def _onward(self, way: float) -> "_Start":
        onward, part = super()._onward(way), way / (self.state.approach - self._last.approach)
        aside = self.state.aside + part * (self.state.aside - self._last.aside)
        return replace(onward, aside=aside)

    def _set_back(self, state: "_Start", to: np.ndarray) -> "_Start":
        """The state with its bodies moved back along x, to displacements (n, 2) [m]."""
        return replace(state, displacements=(to,), aside=state.aside + to - state.displacements[0])

    def _linear(self, pressure: np.ndarray, plastic: PlasticState) -> np.ndarray:
        """Displacement (n, 2) [m] of all nodes at small strains, held ones included."""
        displacement = self._contact.compliance.displacement(pressure, self._friction)
        displacement = displacement + self.body.body.solve(self.body.plastic_force(plastic))
        if self._opposite is None:
            return displacement
        return np.vstack([displacement, self._opposite.displacement(pressure, -self._friction)])

    def _near(self, load: float, plastic: PlasticState) -> "_Start | None":
        [there] = self.state.displacements if self.state.load else [self._contact.linear]
        pressing = self._contact.pressing(load, there, self.state.pressure)
        linear = super()._near(pressing, plastic)
        if linear is None:
            return None
        moved = self._linear(linear.pressure, plastic)
        moved = moved + np.where(self._response.held, 0.0, self._beyond)
        back, _ = self._contact.set_back(moved, linear.pressure)
        return self._set_back(_Start((moved,), linear.pressure, linear.approach, load), back)

    def _accept(self, state: "_Start") -> None:
        self._former, self._last = (self.state.load, self.body.state), self.state
        self._response.accept(state.displacements[0])
        self.state = state
        self._book(state.pressure)
        linear = self._linear(state.pressure, self.body.state)
        self._beyond = state.displacements[0] - state.aside - linear
        gap, _ = self._contact.contact.loaded(state.displacements[0], state.pressure)
        self._gap = gap - self._nearly.flexible @ state.pressure

    def _book(self, pressure: np.ndarray) -> None:
        [both], count = self.state.displacements, len(self.body.held)
        force = self._contact.contact.loaded(both, pressure)[1].reshape(-1, 2)[:count]
        inside = self.body.force(both[:count])
        # the support moves along x, and a far field
        self._account.add(np.where(self.body.held, inside, force), both[:count])
