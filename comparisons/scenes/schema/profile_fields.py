"""Field types that only a profile has: a cut-off and a straight line on a map."""

from comparisons.common.units import LENGTH, describe
from comparisons.scenes.schema.fields import FieldType, Number

AUTOMATIC = "auto"
POSITIVE = Number(LENGTH, above=0.0)
PLACE = Number(LENGTH, at_least=0.0)


class CutOff(FieldType):
    """A length above 0, or "auto"."""

    def read(self, given: object) -> float | str:
        if given == AUTOMATIC:
            return AUTOMATIC
        try:
            return POSITIVE.read(given)
        except ValueError as error:
            raise self.wrong(str(error).partition(";")[0]) from error

    def allowed(self) -> str:
        return f'{POSITIVE.allowed()}, or "{AUTOMATIC}"'


class Segment(FieldType):
    """[[x0, y0], [x1, y1]]: two points of two lengths each, at least 0."""

    def read(self, given: object) -> tuple[tuple[float, float], tuple[float, float]]:
        points = self._pair(given)
        start, stop = (
            tuple(self._length(value) for value in self._pair(point)) for point in points
        )
        if start == stop:
            raise self.wrong("starts where it ends")
        return start, stop

    def _pair(self, given: object) -> list | tuple:
        if not isinstance(given, list | tuple):
            raise self.wrong(f"holds {describe(given)}")
        if len(given) != 2:
            raise self.wrong(f"holds a list of {len(given)}")
        return given

    def _length(self, given: object) -> float:
        try:
            return PLACE.read(given)
        except ValueError as error:
            raise self.wrong(f"holds a place that {str(error).partition(';')[0]}") from error

    def allowed(self) -> str:
        return 'two points, such as [["0 um", "10 um"], ["500 um", "10 um"]], none below 0'
