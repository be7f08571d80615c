"""The report: one self-contained page and its pictures."""

from functools import partial
from importlib import import_module

PAGE = "comparisons.output.page.page"
# Imports of what draws it, none of which takes a tenth of a second.
_DRAWING = ("", ".backend_bases", ".axes", ".figure", ".backends.backend_svg", ".style")
IMPORTS = [partial(import_module, name) for name in (PAGE, *(f"matplotlib{m}" for m in _DRAWING))]
