"""A roller pressed on a body that flows at finite strains, released, and pressed again.

As `fem.nonlinear.press_plastic`, without linearisation: the body is a
`fem.nonlinear.finite_plasticity.FinitePlasticBody`, an elastic roller follows its own law at finite
strains, and contact and friction are on the deformed surfaces (`FiniteContact` of
`fem.nonlinear.finite_deformation`, which also says why bodies are moved back along x). The loads
are reached by the same increments. Each starts from the last contact, changed as that of small
strains on the linear compliances changes.

Newton's systems have the unknowns of small strains: the body's, and the condensed compliance of the
linear roller. What the roller does beyond that is of the order of its strains, and follows from
step to step; the contact that is left is right to the residual.

Nomenclature as of `fem.contact.nonlinear`."""

from dataclasses import dataclass, replace

import numpy as np

from fem.compliance.condensed import Condensed
from fem.contact.nonlinear import ContactState, NonlinearSolution
from fem.contact.terms import ContactTerms
from fem.nonlinear.finite_deformation import (
    LEANING,
    MOST_SETTINGS,
    FiniteContact,
    FiniteDeformation,
)
from fem.nonlinear.finite_plasticity import FinitePlasticBody
from fem.nonlinear.newton import RESIDUAL, newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic, PlasticState
from fem.nonlinear.press_plastic import TRAVEL, LoadHistory, PlasticContact, unloaded
from fem.solver.mumps import FemError

# Residual on the way to a load, in which gaps count, too: it moves pressures under it by 2e-7.
ON_THE_WAY = 5e-4
# Forces left of the roller over the contact's: as a part of the change of the pressures, and least.
FOLLOWS, CLOSEST = 0.03, 1e-10
ROUNDED = 1e-6  # of forces on large elements, which hardly move the surface
MOST_CORRECTIONS = 25


@dataclass(frozen=True)
class FinitePlasticContact(PlasticContact):
    """`PlasticContact` at finite strains. The pressure is the vertical force per undeformed length
    of x, and the plastic strain logarithmic, in the axes of the undeformed body."""

    deformed: FiniteDeformation  # positions, stretches, Cauchy's pressure and gap; not its stresses


class _Surfaces:
    """The contact on deformed surfaces as one of the body alone (`fem.contact.terms.Contact`): an
    elastic roller is in equilibrium with the pressures, by corrections on its linear factor,

        v <- v + K^-1 (T(u, v) p - F(v)).

    What it gives way to the pressures, C p on the undeformed surfaces, is left out of the gap: the
    condensed compliance adds it, as that of small strains. Bodies are moved back along x.

    roller  displacement v (m, 2) [m] of its nodes, none of a rigid one"""

    def __init__(self, contact: FiniteContact, flexible: Condensed | None) -> None:
        self.frictionless, self._contact, self._flexible = not contact.friction, contact, flexible
        self._count = len(contact.body.nodes)
        self.roller = np.zeros((len(contact.linear) - self._count, 2))
        pair = contact.contact
        self._terms = pair.at if flexible is None else pair.on_body
        self.begin(self.roller)

    def begin(self, roller: np.ndarray) -> None:
        """Begin from another displacement (m, 2) [m] of the roller."""
        self.roller, self._last_terms = roller, None
        self._there: tuple[np.ndarray, np.ndarray] | None = None  # where it has followed to

    def placed(self, displacement: np.ndarray, pressure: np.ndarray) -> np.ndarray:
        """Displacements (n + m, 2) [m] of both bodies, moved back along x, which changes no forces;
        a disc is not turned."""
        both = np.vstack([displacement, self.roller])
        return self._contact.set_back(both, pressure, turned=False)[0]

    def loaded(
        self, displacement: np.ndarray, pressure: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """See `fem.contact.terms.Contact`. The roller follows where the body has moved."""
        terms = self._last_terms
        if terms is not None and np.array_equal(self._there[0], displacement):
            return self._stiff(terms.gap, pressure), terms.force @ pressure
        gap, force = self._followed(displacement, pressure)
        return self._stiff(gap, pressure), force

    def at(self, displacement: np.ndarray, pressure: np.ndarray) -> ContactTerms:
        """See `fem.contact.terms.Contact`."""
        self._followed(displacement, pressure)
        self._last_terms = self._terms(self.placed(displacement, pressure), pressure)
        return replace(self._last_terms, gap=self._stiff(self._last_terms.gap, pressure))

    def _stiff(self, gap: np.ndarray, pressure: np.ndarray) -> np.ndarray:
        return gap if self._flexible is None else gap - self._flexible @ pressure

    def _followed(
        self, displacement: np.ndarray, pressure: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """The gap (count,) [m^2] and the forces (2n,) [N/m] on the body, where the roller has
        followed. Raises FemError where it finds no equilibrium."""
        there, wanted, before = (displacement, pressure), FOLLOWS, np.inf
        if self._there is not None:
            if all(map(np.array_equal, self._there, there)):
                return self._met
            change = np.linalg.norm(pressure - self._there[1]) / np.linalg.norm(pressure)
            wanted = float(np.clip(FOLLOWS * change, CLOSEST, FOLLOWS))
        self._there, self._last_terms = there, None
        for _ in range(MOST_CORRECTIONS):
            both = self.placed(*there)
            gap, force = self._contact.contact.loaded(both, pressure)
            self._met = gap, force[: 2 * self._count]
            if self._flexible is None:
                return self._met
            roller, applied = self._contact.response.parts[1], force[2 * self._count :]
            left = applied.reshape(-1, 2) - roller.force(self.roller)
            left = np.where(roller.held, 0.0, left)
            rest = np.linalg.norm(left) / np.linalg.norm(applied)
            if rest <= wanted or (rest > 0.5 * before and rest < ROUNDED):
                return self._met
            self.roller, before = self.roller + self._contact.elastic[1].solve(left), rest
        raise FemError(f"forces of {rest:.1e} are left on the roller")


@dataclass(frozen=True)
class _Start(ContactState):
    roller: np.ndarray | float = 0.0  # displacement (m, 2) [m] of an elastic one


class FiniteLoadHistory(LoadHistory):
    """`LoadHistory` at finite strains. The linear compliances lead ahead: gap and displacements are
    those of the last contact, and the linear change since then.

    contact  body and roller, undeformed, with the linear pressure under the first load; the body's
             material is the metal's elastic one, whose law is not asked for: it is Hencky's
    metal    of the body; the roller, where it is elastic, stays so
    travel   hats that an edge of the contact may travel in one increment

    Loads are the vertical force of pressures and their friction. Stresses and plastic strain at the
    mesh's points, which move by `displacement`, are `fem.nonlinear.press_plastic.plastic_fields` of
    the body and a contact; they are Cauchy's."""

    kind = FinitePlasticBody

    def __init__(
        self, contact: FiniteContact, metal: ElasticPlastic, travel: float = TRAVEL
    ) -> None:
        roller = contact.roller if len(contact.elastic) > 1 else None
        start, gap, friction = contact.start, contact.gap, contact.friction
        super().__init__(
            contact.compliance, metal, gap, contact.weights, start, friction, roller, travel
        )
        self._contact, self._opposite = contact, roller
        self._surfaces = _Surfaces(contact, self._flexible)
        self._bodies = [(self.body, self._surfaces)]
        self._still = np.zeros(self.body.held.shape), self._surfaces.roller
        self._beyond = self._still  # displacements of both bodies that are not linear
        self.state = self._last = _Start(
            (self._still[0],), start, approach=0.0, roller=self._still[1]
        )

    def contact(self, load: float, iterations: int) -> FinitePlasticContact:
        common = dict(vars(super().contact(load, iterations)))
        state, weights = self.state, self._weights
        both = self._both(state)
        common["displacement"] = both[: len(self.body.held)]
        opening = self._contact.contact.loaded(both, state.pressure)[0] / weights
        state = replace(state, displacements=(both,), pressure=common["pressure"])
        solution = NonlinearSolution(state, opening - state.approach, ())
        return FinitePlasticContact(**common, deformed=self._contact.deformed(solution))

    def release(self) -> None:
        """Without the roller: from the last touch, unloaded elastically."""
        state, [displacement] = self.state, self.state.displacements
        linear = self._contact.compliance.displacement(state.pressure, self._friction)
        scale = np.abs(self._force(state)).max()
        free = unloaded(self.body, displacement - linear, scale)
        self.state = replace(state, displacements=(free,))

    def _both(self, state: "_Start") -> np.ndarray:
        """Displacements (n + m, 2) [m] of both bodies, moved back along x."""
        both = np.vstack([state.displacements[0], state.roller])
        return self._contact.set_back(both, state.pressure, turned=False)[0]

    def _force(self, state: "_Start") -> np.ndarray:
        """Nodal forces (n, 2) [N/m] of the contact on the body."""
        force = self._contact.contact.loaded(self._both(state), state.pressure)[1]
        return force.reshape(-1, 2)[: len(self.body.held)]

    def _solved(
        self,
        start: "_Start",
        load: float | None,
        approach: float | None = None,
        residual: float = RESIDUAL,
    ) -> tuple["_Start", int]:
        """See `LoadHistory`; pressures bear what their friction leaves of the load. Both are made
        more accurate in turn."""
        contacts, asked, left = 0, None, 1.0
        goal = residual if residual == RESIDUAL else ON_THE_WAY
        if load is not None:
            asked = self._contact.pressing(load, self._both(start), start.pressure)
        for _ in range(MOST_SETTINGS):
            left = max(goal, ON_THE_WAY * left)
            self._surfaces.begin(start.roller)
            end, residuals = newton_by_contacts(
                *(self._bodies, np.zeros_like(self._gap), self._weights, start, asked, approach),
                residual=left,
                flexible=self._flexible,
                factor=self._factor,
            )
            contacts += len(residuals)
            start = _Start(
                end.displacements, end.pressure, end.approach, load, self._surfaces.roller
            )
            borne, off = self._contact.borne(self._both(start), start.pressure), 0.0
            if load is not None:
                off, asked = abs(borne / load - 1.0), asked * load / borne
            if left == goal and off <= max(goal, LEANING):
                break
        return replace(start, load=load or borne), contacts

    def _onward(self, way: float) -> "_Start":
        part = way / (self.state.approach - self._last.approach)
        roller = self.state.roller + part * (self.state.roller - self._last.roller)
        return replace(super()._onward(way), roller=roller)

    def _linear(
        self, pressure: np.ndarray, plastic: PlasticState, near: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Displacements (n, 2), (m, 2) [m] of both bodies at small strains, held nodes included;
        `near` is that of the body where it is known."""
        displacement = near
        if near is None:
            force = self._contact.compliance.load(pressure, self._friction)
            displacement = self.body.body.solve(force + self.body.plastic_force(plastic))
        if self._opposite is None:
            return displacement, self._still[1]
        return displacement, self._opposite.displacement(pressure, -self._friction)

    def _near(self, load: float, plastic: PlasticState) -> "_Start | None":
        state = self.state
        if not state.load:
            both = np.split(self._contact.linear, [len(self.body.held)])
            state = replace(state, displacements=(both[0],), roller=both[1])
        pressing = self._contact.pressing(load, self._both(state), state.pressure)
        linear = super()._near(pressing, plastic)
        if linear is None:
            return None
        moved = self._linear(linear.pressure, plastic, linear.displacements[0])
        held = self.body.held, self._opposite and self._opposite.body.held
        pairs = zip(moved, self._beyond, held, strict=True)
        body, roller = (u if h is None else u + np.where(h, 0.0, more) for u, more, h in pairs)
        return _Start((body,), linear.pressure, linear.approach, load, roller)

    def _accept(self, state: "_Start") -> None:
        self._former, self._last = (self.state.load, self.body.state), self.state
        self.body.accept(state.displacements[0])
        if self._opposite is not None:
            self._contact.response.parts[1].accept(state.roller)
        self.state = state
        linear = self._linear(state.pressure, self.body.state)
        both = state.displacements[0], state.roller
        self._beyond = [u - v for u, v in zip(both, linear, strict=True)]
        gap, _ = self._contact.contact.loaded(self._both(state), state.pressure)
        self._gap = gap - self._nearly.flexible @ state.pressure
