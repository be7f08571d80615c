"""The finite-element codes under comparison: how each is started, and how to get what is absent."""

import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from comparisons.benchmarks.finite_element_peers import calculix as fe_peers_calculix
from comparisons.benchmarks.finite_element_peers import freefem as fe_peers_freefem
from comparisons.benchmarks.finite_element_peers.process import Code, by_program, runs

OURS = "crosscheck"
SETTINGS = {
    "21": "quadratic, a hat an edge",
    "21s": "quadratic, a hat, smooth",
    "22": "quadratic, two hats an edge",
    "22s": "quadratic, two hats, smooth",
    "32": "cubic, two hats an edge",
    "32s": "cubic, two hats, smooth",
}


@dataclass(frozen=True)
class Peer:
    """Another code.

    start  the command that it is started with, for the option of the same name
    check  arguments with which the command succeeds where the peer is there; None where the command
           itself is the peer
    get    how to get it
    code   its configuration, from the command
    """

    name: str
    option: str
    start: str
    check: tuple[str, ...] | None
    get: str
    code: Callable[[str], Code]


def ours() -> list[Code]:
    """This project's configurations."""
    return [our_code(settings) for settings in SETTINGS]


def our_code(settings: str) -> Code:
    """One of SETTINGS."""
    solve = by_program(sys.executable, "fe_peers_crosscheck", settings)
    return Code(OURS, SETTINGS[settings], solve)


def _program(name: str, how: str, module: str) -> Callable[[str], Code]:
    return lambda interpreter: Code(name, how, by_program(interpreter, module))


def _binary(name: str, how: str, solve: Callable) -> Callable[[str], Code]:
    return lambda command: Code(name, how, partial(solve, command))


PEERS = (
    Peer(
        "CalculiX",
        "--calculix",
        "ccx",
        None,
        "apt-get install --no-install-recommends calculix-ccx",
        _binary("CalculiX", "CPE6, face-to-face penalty", fe_peers_calculix.solve),
    ),
    Peer(
        "FreeFEM",
        "--freefem",
        "FreeFem++-nw",
        None,
        "apt-get install --no-install-recommends freefem++",
        _binary("FreeFEM", "P2, active set", fe_peers_freefem.solve),
    ),
    Peer(
        "getfem",
        "--getfem",
        "/usr/bin/python3",
        ("-c", "import getfem"),
        "apt-get install --no-install-recommends python3-getfem",
        _program("getfem", "P2, augmented Lagrangian", "fe_peers_getfem"),
    ),
    Peer(
        "scikit-fem",
        "--scikit-fem",
        sys.executable,
        ("-c", "import skfem"),
        "pip install scikit-fem, in any environment; name its python",
        _program("scikit-fem", "P2, active set", "fe_peers_scikit_fem"),
    ),
)


def there(peer: Peer, command: str) -> bool:
    """Whether a peer can be started by a command."""
    found = shutil.which(command) is not None
    return found and (peer.check is None or runs((command, *peer.check)))
