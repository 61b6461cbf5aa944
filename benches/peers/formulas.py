"""The formulas that the Rust side wrote out, as functions over any tool's numbers."""

import importlib.util
import json
import math
from pathlib import Path
from types import SimpleNamespace

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


def module(folder):
    """The written-out module, one function for each field, which gives its formulas by their names."""
    spec = importlib.util.spec_from_file_location("written_formulas", Path(folder) / "formulas.py")
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
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
