"""Digits near zero unstable points, where a width vanishes between two regions.

Rotors with the disk asymmetry that closes the simple region at an angle of 90°, off by a small distance in both; the widths
in 50 digits are the reference.
"""

import numpy as np

import formulas
import texts

# Relative distance of the asymmetry, and distance of the angle in radians, from the zero unstable point.
DISTANCES = (1e-2, 1e-4, 1e-6)
ROTORS = 64
DIGITS = 50


def closing_asymmetries(loaded, columns):
    """The disk asymmetry of each rotor that closes its simple region."""
    return loaded.rotor()["sir_zup_asymmetry"](texts.Arrays({}), texts.SimpleNamespace(**dict(zip(texts.COLUMNS, columns))))


def written(folder):
    """Writes rotors and angles for each distance; the files' names and the simple region's exact widths."""
    import mpmath

    mpmath.mp.dps = DIGITS
    loaded = formulas.module(folder)
    columns = [column[:ROTORS] for column in np.fromfile(folder / "columns.f64").reshape(len(texts.COLUMNS), -1)]
    sympy, symbols, results = texts.expressions(loaded)
    exact = sympy.lambdify(symbols, results[0], "mpmath")
    places = []
    for number, distance in enumerate(DISTANCES):
        closing = closing_asymmetries(loaded, columns)
        rotors = [*columns[:6], closing * (1.0 + distance * np.where(np.arange(ROTORS) % 2, 1.0, -1.0))]
        angles = np.pi / 2 + distance * np.array([-1.0, -0.5, -0.1, 0.1, 0.5, 1.0])
        files = folder / f"near_{number}_rotors.f64", folder / f"near_{number}_angles.f64"
        np.concatenate(rotors).tofile(files[0])
        angles.tofile(files[1])
        points = [[column[row] for column in rotors] + [angle] for row in range(ROTORS) for angle in angles]
        reference = np.array([float(exact(*map(mpmath.mpf, point))) for point in points])
        places.append((files, reference))
    return places


def largest_errors(process, form, places, folder):
    """The largest relative error of the simple region's width at each distance; none where a result is no number."""
    errors = []
    for (rotors, angles), reference in places:
        file = folder / "near_found.f64"
        process.ask(f"near {form} {rotors} {angles} {file}")
        found = np.split(np.fromfile(file), 2)[0]
        worst = float(np.max(np.abs(found / reference - 1.0)))
        errors.append(worst if np.isfinite(worst) else None)
    return errors
