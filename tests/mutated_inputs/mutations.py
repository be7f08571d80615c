"""Mistakes in the text of scenes and the bytes of profiles, drawn at random."""

import io
import random
import re

import numpy as np

from comparisons.scenes.fields import file_fields
from comparisons.scenes.scene import Scene, sections_of

STEEL = 'youngs_modulus = "207 GPa"\npoissons_ratio = 0.3\n'
BODIES = f'[roller]\nradius = "8.2 mm"\n{STEEL}[body]\n{STEEL}'
LOAD = '[load]\nper_length = "0.1 N/um"\nfriction = [0.0, 0.1]\n'
STRESS = "[stress]\ndepth = 1.0\nhalf_range = 1.5\npoints = [12, 6]\n"
# What the library's scenes leave out.
FULL = (
    BODIES + "width = 0.04\nhardness = 7e9\nyield_stress = 2e9\nhardening_modulus = 1e9\n" + LOAD,
    '[roller]\nradius = "8.2 mm"\nrigid = true\n[body]\nthickness = "5 mm"\nbase = "bonded"\n'
    f'{STEEL}[load]\napproach = "2 um"\n{STRESS}',
    BODIES + LOAD + STRESS + "[tolerance]\npeak_pressure = 0.01\ntau1_max = 0.01\n"
    "[finite_element]\nblock = 40.0\ngrowth = 0.2\n[resolution]\npitch = 2e-5\nlevels = 2\n"
    '[budget]\ntime = "10 s"\nmemory = "4 GB"\neffects = false\n',
    BODIES + LOAD + '[profile]\nkind = "turned"\nfeed = "100 um"\nnose_radius = "0.8 mm"\n'
    'length = "4 mm"\nnoise = "10 nm"\nnoise_wavelength = "20 um"\nsamples_per_feed = 32\n',
    BODIES + LOAD + '[profile]\nkind = "ground"\nrms_height = "0.4 um"\nsamples = 1024\n'
    'length = "4 mm"\nshortest_wavelength = "16 um"\nroll_off_wavelength = "100 um"\n'
    'longest_wavelength = "1 mm"\ncutoff = "auto"\nshort_cutoff = "5 um"\n',
    BODIES + LOAD + '[profile]\nkind = "self-affine"\nhurst = 0.8\nrms_slope = 0.05\n'
    'samples = 512\nlength = "4 mm"\nseed = 3\n[running_in]\nstroke = "0.2 mm"\npasses = 3\n'
    'hardness = "7 GPa"\n',
    'coating = {thickness = "2 um", youngs_modulus = "400 GPa", poissons_ratio = 0.2}\n'
    + BODIES
    + LOAD,
)
NUMBERS = (
    *("0", "-0.0", "1", "-1", "0.5", "2", "3", "7", "1e-30", "1e-31", "1e30", "1e31", "1e300"),
    *("1e308", "-1e300", "5e-324", "1e-300", "1e290", "inf", "-inf", "nan", "1_000", "0x10", "1e3"),
    *("9223372036854775807", "-9223372036854775808", "0.49999999999", "0.1e-6", "2e-16", "1e15"),
    *("9" * 400, "1000000000", "16000000", "0.288e-6", "1e-12", "1e12", "1e-6", "1e6", "99999"),
)
UNITS = (
    *("m", "mm", "um", "µm", "nm", "inch", "mil", "Pa", "GPa", "N/um", "N/m", "m/m", "m*m/m", "%"),
    *("1/m", "m/mm", "mm/mm", "m**0", "um/um*m", "degC", "dB", "rad", "byte", "s", "km", "ly"),
    *("meter", "kilometer/meter", "metre", "m^2", "N*m", "Pa*m", "psi", "lbf/inch", "", "µ", "K"),
    *("delta_degC", "count", "bit", "m m", "m/m/m", "planck_length", "cm/m", "furlong", "ppm"),
)
WORDS = (
    *('""', '" "', '"auto"', '"none"', '"nan m"', '"1e400 m"', "true", "false", "[]", "{}", "[[]]"),
    *('"trace.csv"', '"../../../etc/hostname"', '"\\u0000"', '"\\u001b[31m"', '"/dev/null"'),
    *("1979-05-27", "07:32:00", "1979-05-27T07:32:00Z", '"rough"', '"finite"', '"disc"', '"P3"'),
    *('"line"', '"arc"', '"mean"', '"bridge"', '"murnaghan"', '"murnagham"', '"hencky"', '"."'),
    *("[3, 16000000]", "[3, 3]", "[1e3, 3]", "[0.0, 0.0]", "[0.1, 0.2, 0.3]", '["1 um", "2 um"]'),
    *('{l = 1, m = "2", n = 3}', "[[0, 0], [1e-3, 1e-3]]", "[[0, 0], [0, 0]]", "{a = {b = 1}}"),
    *(f'"{"x" * 5000}"', '"self-affine"', '"sinusoid"', '"turned"', '"ground"', '"half-plane"'),
    *('"1.000.000 Pa"', '"1,5 mm"', '"8.2mm"', '"８.２ mm"', "'''\ntwo\nlines'''", '"bonded"'),
)
FIELDS = tuple(
    (section, name) for section, part in sections_of(Scene).items() for name in file_fields(part)
)
ASSIGNED = re.compile(r"^(\s*[\w.]+\s*=\s*)(.+)$", re.MULTILINE)
ALPHABET = "\x00\x01\t\n\r \"'#%,.;:=[]{}+-_/*0123456789eEnxmNPa\x80\xff°µ²\u2212\u3000\u202e\ud800"


def hostile_value(draw: random.Random, former: str = "") -> str:
    """Text of a TOML value in place of a former one."""
    kind = draw.randrange(5)
    number = re.match(r'"?(\d+\.?\d*(?:e[+-]?\d+)?)', former)
    if kind >= 3 and number:  # the former one, of another size: what may still be solved
        size = float(number[1]) * draw.choice((0.5, 0.9, 1.1, 2.0, 10.0, 1e3, 1e-3, 1e9, 1e-12))
        return f"{former[: number.start(1)]}{size:.6g}{former[number.end(1) :]}"
    if kind == 0:
        return draw.choice(NUMBERS)
    if kind == 1:
        return f'"{draw.choice(NUMBERS)} {draw.choice(UNITS)}"'
    if kind == 2:
        size = draw.choice((1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9, 1e12)) * draw.uniform(0.1, 10.0)
        return f"{size:.6g}"
    return draw.choice(WORDS)


def flipped(draw: random.Random, content: bytes) -> bytes:
    """Bytes changed, cut off, put in, doubled or swapped."""
    start = draw.randrange(len(content) + 1)
    stop = min(len(content), start + draw.choice((1, 1, 2, 8, 64, 1024)))
    kind = draw.randrange(5)
    if kind == 0:
        changed = bytes(draw.randrange(256) for _ in range(stop - start))
    elif kind == 1:
        changed = "".join(draw.choices(ALPHABET, k=draw.choice((1, 3)))).encode(
            draw.choice(("utf-8", "utf-16", "latin-1")), "replace"
        )
    elif kind == 2:
        changed = content[start:stop] * draw.choice((0, 2, 3, 50))
    elif kind == 3:
        return content[:start]
    else:
        changed = content[start:stop][::-1]
    return content[:start] + changed + content[stop:]


def mutated_scene(draw: random.Random, text: str) -> bytes:
    """The scene with one to three mistakes."""
    broken: bytes | None = None
    for _ in range(draw.choice((1, 1, 1, 2, 3))):
        assigned = list(ASSIGNED.finditer(text))
        lines = text.split("\n")
        kind = draw.randrange(10)
        if kind < 6 and assigned:
            match = draw.choice(assigned)
            text = text[: match.start(2)] + hostile_value(draw, match[2]) + text[match.end(2) :]
        elif kind == 6:  # a field that the scene does not have, in its section
            section, name = draw.choice(FIELDS)
            head = f"[{section}]"
            line = f"{name} = {hostile_value(draw)}"
            where = text.find(head) + len(head)
            text = (
                f"{text[:where]}\n{line}{text[where:]}"
                if head in text
                else f"{text}\n{head}\n{line}\n"
            )
        elif kind == 7:  # a line is lost, or there twice
            line = lines.pop(draw.randrange(len(lines)))
            for _ in range(draw.choice((0, 2))):
                lines.insert(draw.randrange(len(lines) + 1), line)
            text = "\n".join(lines)
        elif kind == 8 and assigned:
            match = draw.choice(assigned)
            name = draw.choice(("", draw.choice(FIELDS)[1], match[1].replace("=", "x ="), "a.b.c"))
            text = f"{text[: match.start(1)]}{name} = {text[match.start(2) :]}"
        else:
            broken = flipped(draw, text.encode())
    return text.encode("utf-8", "surrogatepass") if broken is None else broken


def traces(draw: random.Random) -> tuple[str, bytes, bool]:
    """Name and content of a good file, text in one of its dialects or arrays; and whether it may
    hold heights alone."""
    count = draw.choice((4, 5, 30, 200))
    x = np.arange(count) * draw.choice((0.5, 1.0, 0.1))
    z = np.array([draw.gauss(0.0, 0.5) for _ in range(count)])
    kind = draw.randrange(7)
    if kind >= 5:
        return _arrays(draw, x, z)
    comma, separator = draw.choice(((False, ","), (False, ";"), (True, ";"), (True, "\t")))
    separator = draw.choice((separator, separator, " "))
    number = draw.choice(("{:.6g}", "{:.12f}", "{:e}", "{:.3f}"))
    rows = [[number.format(value) for value in row] for row in zip(x, z, strict=True)]
    if kind == 0:
        rows = [row[1:] for row in rows]
    head = draw.choice(("", "x_um,height_um\n", "# a comment\n", "x [um]\tz [nm]\n", "Date: 1\n\n"))
    text = "\n".join(separator.join(row) for row in rows)
    text = head + (text.replace(".", ",") if comma else text) + draw.choice(("", "\n", "\n\n"))
    text = text.replace("\n", draw.choice(("\n", "\n", "\r\n", "\r")))
    return (
        "trace.csv",
        text.encode(draw.choice(("utf-8", "utf-8-sig", "utf-16", "latin-1"))),
        kind == 0,
    )


def _arrays(draw: random.Random, x: np.ndarray, z: np.ndarray) -> tuple[str, bytes, bool]:
    """Trace in a file of numpy."""
    content, ending = io.BytesIO(), draw.choice(("npy", "npz"))
    if ending == "npy":
        np.save(content, draw.choice((z, np.stack((x, z), axis=1))))
    else:
        np.savez(content, x=x, z=z)
    return f"trace.{ending}", content.getvalue(), ending == "npy"


NUMBER_IN_TEXT = re.compile(rb"[+-]?\d+[.,]?\d*(?:e[+-]?\d+)?")
CELLS = (
    *(b"1e300", b"-1e300", b"1e-300", b"1e290", b"1e308", b"1e999", b"nan", b"inf", b"-inf", b""),
    *(b"BAD", b"0", b"1e30", b"#N/A", b"x", b"--", b"1.2.3", b"1,2,3", b"0x1F", b"1d5", b"9" * 400),
    *(b"1e20", b"-0", b"1e-20", b"***", b"\xb5", b'"', b"1e15", b"1e-12", b"65535", b"4294967295"),
)


def mutated_profile(draw: random.Random, content: bytes) -> bytes:
    for _ in range(draw.choice((1, 1, 2, 3))):
        kind = draw.randrange(8)
        lines = content.split(b"\n")
        numbers = list(NUMBER_IN_TEXT.finditer(content))
        if kind < 3 and numbers:
            match = draw.choice(numbers)
            content = content[: match.start()] + draw.choice(CELLS) + content[match.end() :]
        elif kind == 3 and len(lines) > 2:
            draw.shuffle(lines)
            content = b"\n".join(lines)
        elif kind == 4 and len(lines) > 2:
            at = draw.randrange(len(lines))
            lines[at:at] = [lines[at] + draw.choice((b",", b";", b" 1", b"\t2", b"", b"#"))]
            content = b"\n".join(lines)
        elif kind == 5:  # every height, or every x, scaled
            power = draw.choice((b"e300", b"e-300", b"e150", b"e-20", b"e29", b"e31", b"e8"))
            content = re.sub(rb"(\d)(\r?\n)", rb"\1" + power + rb"\2", content)
        else:
            content = flipped(draw, content)
    return content


def reading_scene(draw: random.Random, name: str, heights_alone: bool) -> str:
    """A scene that reads a trace in one of the many ways."""
    often = {
        "x_unit": ('"um"', '"um"', '"mm"', '"nm"', '"km"'),
        "z_unit": ('"um"', '"um"', '"nm"', '"m"'),
        "form": ('"none"', '"mean"', '"line"', '"arc"'),
        "dropouts": ('"refuse"', '"bridge"', '"bridge"'),
    }
    seldom = {
        "cutoff": ('"auto"', '"80 um"', "1e-30", "1e30"),
        "short_cutoff": ('"2.5 um"', "1e-30", "1e30"),
        "row": ("0", "1", "2000000"),
        "column": ("0", "3"),
        "line": ('[["0 um", "0 um"], ["3 um", "2 um"]]',),
    }
    if heights_alone:
        often["spacing"] = ('"0.5 um"', '"1 mm"', "1e-30", "1e30")
        del often["x_unit"]
    fields = {"file": f'"{name}"'} | {key: draw.choice(choices) for key, choices in often.items()}
    for key, choices in seldom.items():
        if draw.random() < 0.05:
            fields[key] = draw.choice(choices)
    if draw.random() < 0.05:
        del fields[draw.choice(list(fields))]
    profile = "".join(f"{name} = {text}\n" for name, text in fields.items())
    return f"{BODIES}{LOAD}[profile]\n{profile}"
