"""The formulas that the Rust side wrote out, as functions over any tool's numbers."""

import json
import math
from pathlib import Path
from types import ModuleType, SimpleNamespace

CONSTANTS = {"PI": 1.0, "FRAC_PI_2": 0.5, "FRAC_PI_4": 0.25}


class Floats:
    """Formulas over plain floats."""

    sqrt, sin, cos, tan, exp, ln = math.sqrt, math.sin, math.cos, math.tan, math.exp, math.log
    abs = staticmethod(abs)

    @staticmethod
    def number(text):
        return float(text.replace("_", ""))

    @staticmethod
    def constant(name):
        return math.pi * CONSTANTS[name] if name in CONSTANTS else math.log(10.0)

    @staticmethod
    def powi(base, exponent):
        return base**exponent

    @staticmethod
    def struct(**fields):
        return SimpleNamespace(**fields)


# The one formula in which an angle occurs, a² + b² + 2ab cos 2φ: as it is written, so that no digit is lost where it
# vanishes, and as most would write it.
WRITTEN = "op.powi(((a + b) * op.cos(angle)), 2) + op.powi(((a - b) * op.sin(angle)), 2)"
COS_2PHI = 'op.powi(a, 2) + op.powi(b, 2) + op.number("2.0") * a * b * op.cos(op.number("2.0") * angle)'


def module(folder, form="written"):
    """The written-out module, one function for each field, which gives its formulas by their names; with the form
    `cos2phi` the resultant is taken from the cosine of twice the angle."""
    text = (Path(folder) / "formulas.py").read_text()
    if form == "cos2phi":
        if text.count(WRITTEN) != 1:
            raise SystemExit("the resultant of the equations has another text than formulas.py knows")
        text = text.replace(WRITTEN, COS_2PHI)
    loaded = ModuleType(f"formulas_{form}")
    exec(compile(text, f"formulas_{form}", "exec"), vars(loaded))
    return loaded


def descriptions(folder):
    return json.loads((Path(folder) / "formulas.json").read_text())


def flat(value):
    """All numbers of a result, in order."""
    if isinstance(value, (list, tuple)):
        return [number for part in value for number in flat(part)]
    if isinstance(value, SimpleNamespace):
        return [number for part in vars(value).values() for number in flat(part)]
    return [value]


def arguments(description, numbers):
    """A formula's arguments from its symbols' numbers, by name."""
    built = []
    for parameter in description["parameters"]:
        name, kind = parameter["name"], parameter["kind"]
        if kind == "number":
            built.append(numbers.get(name))
        elif kind == "struct":
            prefix = name + "."
            fields = {key[len(prefix):]: value for key, value in numbers.items() if key.startswith(prefix)}
            built.append(SimpleNamespace(**fields))
        else:
            built.append([numbers.get(f"{name}[{place}]") for place in range(kind)])
    return built


def call(loaded, description, op, numbers):
    """The formula's numbers over the tool `op`, from those of its symbols."""
    formula = getattr(loaded, description["field"])()[description["name"]]
    return flat(formula(op, *arguments(description, numbers)))
