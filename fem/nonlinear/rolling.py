"""A roller that rolls over an elastic-plastic half-plane from far behind to far ahead, many times.

Seen from the roller a pass is steady: what a point of the metal undergoes while the roller passes
stands along the line of its depth, from far ahead, where the metal is as the last pass left it, to
far behind. With ep the plastic strain on all these lines,

    ep = march(e(ep)),    e(ep) strain of the elastic bodies in contact with plastic strain ep,

where `march` integrates the flow along each line, point by point of the elements. The iteration is
accelerated by Anderson's method. There are no increments: the mesh's error is all.

What the passes before have left is the same all along the surface, and so are residual stresses,

    sx = -E/(1 - nu^2) (ep_xx + nu ep_yy),   sy the same with xx and yy exchanged,   sz = txz = 0.

Where the cells of the mesh are as wide as a hat, h, fields that move on by h are fields of the same
mesh. Work of the contact is that of its mean pressures over such a step, plastic work that of mean
stresses at points h apart, as `fem.nonlinear.energy` has them of an increment. They balance but for
the coarser cells, and under friction for the ends of the block, which bear its force: there the
stored energy is not that of the residual stresses alone.

Nomenclature as of `fem.contact.nonlinear`. The roller goes towards +x."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fem.contact.nonlinear import ContactState
from fem.nonlinear.cycles import SETTLED, Anderson
from fem.nonlinear.energy import Energies, flow_energy, plastic_parts
from fem.nonlinear.plasticity import PlasticBody, PlasticState, return_mapping
from fem.nonlinear.plasticity import stress as stress_of
from fem.nonlinear.press_plastic import LoadHistory
from fem.solver.mumps import FemError

MOST_ITERATIONS = 300
ROUNDING = 1e-9  # of the body's depth: points of one line
# Of the way to the block's ends: beyond, nothing flows. An end that is held does not let a surface
# pass that flow has moved on, and coarse cells there would yield.
FAR = 0.5


class EndlessBody(PlasticBody):
    """A body whose plastic strain was the same all along the surface, but for what changes now:
    of that alone its displacements come. Its mesh has points on lines of constant depth.

    lines  points of each bundle of lines (n, k), from ahead to behind"""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)
        self._alike, self._strain = np.zeros_like(self.state.strain), 0.0
        depth = np.round(self.points[:, 1] / self.points[:, 1].max() / ROUNDING).astype(int)
        order = np.lexsort([-self.points[:, 0], depth])
        _, first, count = np.unique(depth[order], return_index=True, return_counts=True)
        self.lines = tuple(
            order[first[count == k][:, None] + np.arange(k)] for k in np.unique(count)
        )

    def strain(self, displacement: np.ndarray) -> np.ndarray:
        """As of `PlasticBody`, with that of what is alike."""
        return super().strain(displacement) + self._strain

    def plastic_force(self, state: PlasticState) -> np.ndarray:
        """As of `PlasticBody`, of what is not alike."""
        return super().plastic_force(replace(state, strain=state.strain - self._alike))

    def march(self, strain: np.ndarray) -> PlasticState:
        """The state at all points that strains (3m, 3) lead to, met along the lines."""
        plastic, equivalent = self.state.strain.copy(), self.state.equivalent.copy()
        far = np.abs(self.points[:, 0]) > FAR * self.points[:, 0].max()
        for lines in self.lines:
            now = PlasticState(plastic[lines[:, 0]], equivalent[lines[:, 0]])
            for at in lines.T:
                if not far[at[0]]:
                    now = return_mapping(self.metal, strain[at], now).state
                plastic[at], equivalent[at] = now.strain, now.equivalent
        return PlasticState(plastic, equivalent)

    def spread(self, state: PlasticState) -> None:
        """Give every line the state that a pass leaves at its end."""
        plastic, equivalent = np.empty_like(state.strain), np.empty_like(state.equivalent)
        for lines in self.lines:
            plastic[lines], equivalent[lines] = (
                part[lines[:, -1:]] for part in (state.strain, state.equivalent)
            )
        self.state, self._alike = PlasticState(plastic, equivalent), plastic
        (xx, zz, xz), nu = plastic.T, self.metal.elastic.poissons_ratio
        # ezz of the stresses above, over the thickness, and the shear
        self._strain = np.column_stack([0.0 * xx, zz - nu / (1.0 - nu) * zz, 2.0 * xz])


@dataclass(frozen=True)
class RollingPass:
    """The roller has come from far behind and gone far ahead. Profiles (n,) by depth."""

    pressure: np.ndarray  # (count,) [Pa] under the roller
    opening: np.ndarray  # (count,) [m] mean gap there
    depth: np.ndarray  # [m]
    plastic: np.ndarray  # (n, 4) plastic exx, ezz, gxz, eyy that is left
    added: np.ndarray  # equivalent plastic strain, to and fro, of this pass
    equivalent: np.ndarray  # of all passes
    sx: np.ndarray  # [Pa] that is left
    sy: np.ndarray  # [Pa]
    energies: Energies  # [J/m^2] over the length travelled


class RolledBody(LoadHistory):
    """The contact from pass to pass; arguments as of `press_plastically`, of a structured mesh."""

    kind = EndlessBody

    def roll(self, load: float) -> RollingPass:
        """A pass under a load [N/m]. Raises FemError where it does not settle."""
        body, before = self.body, self.body.state
        shear, limit = body.metal.elastic.shear_modulus, body.metal.hardening.yield_stress
        mixed = Anderson(before.strain)
        for _ in range(MOST_ITERATIONS):
            end = self._frozen(load, replace(before, strain=mixed.point))
            if end is None:
                raise FemError("the contact of a body that is rolled over did not settle")
            self.state = replace(self.state, pressure=end.pressure)
            strain = body.strain(end.displacements[0])
            now = body.march(strain)
            if 2.0 * shear * np.abs(now.strain - mixed.point).max() <= SETTLED * limit:
                break
            mixed.next(now.strain)
        else:
            raise FemError(f"a pass did not settle in {MOST_ITERATIONS} iterations")
        moved = self._compliance.weighted(end.displacements[0])
        if self._flexible is not None:
            moved = moved + self._flexible @ end.pressure
        opening = (self._gap + moved) / self._weights - end.approach
        energies = self._spread(end, strain, now)
        return RollingPass(end.pressure, opening, **self._profiles(before), energies=energies)

    @cached_property
    def _profile(self) -> tuple[np.ndarray, np.ndarray]:
        """A point of each line (n,) by depth, and the thickness (n,) [m] that it stands for."""
        body, span = self.body, np.ptp(self.body.body.nodes[:, 0])
        first = np.concatenate([lines[:, 0] for lines in body.lines])
        area = np.concatenate([body.areas.ravel()[lines].sum(axis=1) for lines in body.lines])
        order = np.argsort(body.points[first, 1])
        return first[order], area[order] / span

    def _rest(self) -> np.ndarray:
        """sx, sz, txz, sy [Pa] (n, 4) that are left along the profile."""
        at, _ = self._profile
        state = PlasticState(self.body.state.strain[at], self.body.state.equivalent[at])
        strain = self.body.strain(np.zeros_like(self.body.body.nodes))[at]
        return np.column_stack(stress_of(self.body.metal, strain, state))

    def _spread(self, end: ContactState, strain: np.ndarray, now: PlasticState) -> Energies:
        """Leave all along the surface what the pass leaves at its end; its energies [J/m^2]."""
        body, pressure = self.body, end.pressure
        cells = min(lines.shape[1] for lines in body.lines)
        stress, plastic = np.column_stack(stress_of(body.metal, strain, now)), plastic_parts(now)
        flowed, taken, spent = flow_energy(body.metal, now), 0.0, 0.0
        for lines in body.lines:
            step = lines.shape[1] // cells  # to the same point of the next cell
            area = body.areas.ravel()[lines].sum(axis=1) / np.ptp(body.body.nodes[:, 0])
            mean = 0.5 * (stress[lines[:, step:]] + stress[lines[:, :-step]])
            flow = plastic[lines[:, step:]] - plastic[lines[:, :-step]]
            taken += float(area @ (mean * flow).sum(axis=(1, 2))) / step
            spent += float(area @ (flowed[lines[:, -1]] - flowed[lines[:, 0]]))
        # as the roller goes on by a hat, each hat gets the pressure and the place of the one behind
        surface = end.displacements[0][self._compliance.body.surface.point].ravel()
        moved = self._compliance.weighted(end.displacements[0])
        if self._friction:
            moved = moved + self._friction * (self._compliance.tangential.T @ surface)
        mean = 0.5 * (pressure[1:] + pressure[:-1]) / self._weights[:-1]
        stored = self._stored()
        body.spread(now)
        return Energies(-float(mean @ np.diff(moved)), self._stored() - stored, taken, spent)

    def _stored(self) -> float:
        """Elastic energy [J/m^2] of the stresses that are left."""
        sx, _, _, sy = self._rest().T
        nu, modulus = self.body.metal.elastic.poissons_ratio, self.body.metal.elastic.youngs_modulus
        return float(self._profile[1] @ (sx**2 + sy**2 - 2.0 * nu * sx * sy)) / (2.0 * modulus)

    def _profiles(self, before: PlasticState) -> dict[str, np.ndarray]:
        """Of a pass from a plastic state on, by their names in `RollingPass`."""
        at, now, rest = self._profile[0], self.body.state, self._rest()
        return {
            "depth": self.body.points[at, 1],
            "plastic": plastic_parts(now)[at],
            "added": (now.equivalent - before.equivalent)[at],
            "equivalent": now.equivalent[at],
            "sx": rest[:, 0],
            "sy": rest[:, 3],
        }
