"""Writes width_gradients.csv: both widths, Eq. (31), of rotors of every crack model and their partials by every input.

Straight from the definitions, Eqs. (6) to (8), (10), (12), (15), (16), (23), (25) and (31) with the corrections E3 to E9,
in 60 decimal digits. The double integrals are taken over the angle of the strip on the shaft's circle, mu = sin(theta),
and the share alpha = xi / h of its height; each partial is a central difference whose step of 1e-16 of the input leaves
about 30 digits. Run it with mpmath 1.3 in this folder: python3 width_gradients.py
"""

from functools import cache

from mpmath import acos, cos, matrix, mp, mpf, nstr, pi, sin, sqrt, tan
from mpmath.calculus.quadrature import GaussLegendre

mp.dps = 60
STEP = mpf(10) ** -16

INPUTS = (
    "disk_mass",
    "disk_diametral_inertia",
    "disk_polar_inertia",
    "disk_asymmetry",
    "disk_position_ratio",
    "shaft_length",
    "shaft_radius",
    "shaft_youngs_modulus",
    "shaft_poissons_ratio",
    "crack_depth_ratio",
    "crack_position_ratio",
    "crack_angle",
)

# The inputs in that order, the crack's model and how much of its edge opens.
ROTORS = (
    # The paper's rotor, between its two extreme angles and a little beside one.
    ("10.43 0.1397 0.2096 0.2 0.25 0.5045 0.01188 2.0e11 0.3 0.2 0.5 0.7", "support-arm", "half"),
    ("10.43 0.1397 0.2096 0.2 0.25 0.5045 0.01188 2.0e11 0.3 0.2 0.5 1.5", "support-arm", "half"),
    ("4.7 0.083 0.061 0.13 0.62 0.71 0.0153 1.1e11 0.34 0.41 0.37 -0.9", "support-arm", "full"),
    # beta = 1, where Eq. (15) as printed is 0/0.
    ("7.3 0.25 0.25 -0.11 0.31 0.62 0.0142 2.05e11 0.29 0.35 0.44 2.3", "support-arm", "full"),
    ("21.5 0.66 1.07 0.08 0.37 1.13 0.0227 0.71e11 0.33 0.53 0.21 0.4", "midspan-arm", "half"),
    ("2.9 0.041 0.033 0.27 0.71 0.48 0.0109 1.9e11 0.27 0.66 0.83 1.1", "midspan-arm", "full"),
    # Crack left of the disk.
    ("10.43 0.1397 0.2096 0.05 0.45 0.5045 0.01188 2.0e11 0.3 0.6 0.3 0.7", "simply-supported", "half"),
    ("33.1 1.27 2.21 -0.17 0.66 1.42 0.0311 1.6e11 0.31 0.45 0.52 -2.2", "simply-supported", "full"),
    # Crack right of the disk.
    ("10.43 0.1397 0.2096 0.05 0.25 0.5045 0.01188 2.0e11 0.3 0.6 0.4 0.7", "simply-supported", "half"),
    ("5.9 0.19 0.131 0.09 0.28 0.83 0.0174 2.1e11 0.28 0.7 0.57 1.9", "simply-supported", "full"),
    # A shallow crack.
    ("10.43 0.1397 0.2096 0.2 0.25 0.5045 0.01188 2.0e11 0.3 0.02 0.5 0.7", "support-arm", "half"),
    # A disk near midspan, where displacement and tilt are weakly coupled.
    ("16.2 0.37 0.62 0.12 0.49 0.92 0.0196 2.0e11 0.3 0.3 0.46 0.6", "simply-supported", "half"),
)

rule = GaussLegendre(mp)
OUTER, INNER = 7, 6


@cache
def nodes(degree):
    """Places in (0, 1) and their weights."""
    return [((1 + x) / 2, weight / 2) for x, weight in rule.calc_nodes(degree, mp.prec)]


def squared_factors(alpha):
    """Squares of the geometry factors F_II, F_III, F_2 and F_1 (E5)."""
    l = pi * alpha / 2
    tada, sine, cosine = tan(l) / l, sin(l), cos(l)
    sliding = mpf("1.122") - mpf("0.561") * alpha + mpf("0.085") * alpha**2 + mpf("0.18") * alpha**3
    opening = mpf("0.923") + mpf("0.199") * (1 - sine) ** 4
    lateral = mpf("0.752") + mpf("2.02") * alpha + mpf("0.37") * (1 - sine) ** 3
    return sliding**2 / (1 - alpha), tada, tada * (opening / cosine) ** 2, tada * (lateral / cosine) ** 2


@cache
def integrals(sigma, outer=OUTER, inner=INNER):
    """The four double integrals of Eq. (8) in the limits of E4."""
    last = acos(1 - sigma)
    sums = [mpf(0)] * 4
    for place, weight in nodes(outer):
        theta = last * place
        height = 2 * cos(theta)
        deepest = (cos(theta) - cos(last)) / height
        strip = [mpf(0)] * 4
        for share, share_weight in nodes(inner):
            alpha = deepest * share
            for which, factor in enumerate(squared_factors(alpha)):
                strip[which] += share_weight * alpha * factor
        # d mu d xi = cos(theta) d theta * height d alpha, and xi = height * alpha.
        scale = weight * last * cos(theta) * deepest * height**2
        edges = (1, 1, cos(theta) ** 2, sin(theta) ** 2)
        sums = [total + scale * edge * part for total, edge, part in zip(sums, edges, strip)]
    return sums


def loads(model, disk, crack, length):
    """Moment and shear at the crack, of a unit force and of a unit couple at the disk."""
    if model == "support-arm":
        return -crack * length, mpf(1), mpf(1), mpf(0)
    if model == "midspan-arm":
        return length / 2 - crack * length, mpf(1), mpf(1), mpf(0)
    if crack < disk:
        return (1 - disk) * crack * length, 1 - disk, -crack, -1 / length
    return disk * (1 - crack) * length, -disk, 1 - crack, -1 / length


def stiffness(model, edge, disk, length, radius, modulus, poisson, depth, crack):
    """Mean and variation of each of the entries tt, tm, mm, Eq. (10)."""
    sliding, tearing, opening, lateral = integrals(depth)
    plane = (1 - poisson**2) / (pi * modulus * radius)
    c11, c22 = 4 * plane * sliding, 4 * plane * tearing
    c33, c44 = 64 * plane / radius**2 * opening, edge * plane / radius**2 * lateral
    second_moment = pi * radius**4 / 4
    left, right = disk * length, length - disk * length
    f11 = (left * right) ** 2 / (3 * modulus * second_moment * length)
    f44 = (left**3 + right**3) / (3 * modulus * second_moment * length**2)
    f14 = left * right * (length - 2 * left) / (3 * modulus * second_moment * length)
    moment_f, shear_f, moment_m, shear_m = loads(model, disk, crack, length)

    def inverse(shear, bending):
        a11 = f11 + shear * shear_f**2 + bending * moment_f**2
        a14 = f14 + shear * shear_f * shear_m + bending * moment_f * moment_m
        a44 = f44 + shear * shear_m**2 + bending * moment_m**2
        return matrix([[a11, a14], [a14, a44]]) ** -1

    first, second = inverse(c11, c44), inverse(c22, c33)
    entries = ((0, 0), (0, 1), (1, 1))
    mean = [(first[i, j] + second[i, j]) / 2 for i, j in entries]
    return mean, [(first[i, j] - second[i, j]) / 2 for i, j in entries]


def width(omega, speed, beta, gamma, delta, e1, e12, e2, asymmetry, angle):
    """Eq. (31), where omega and 2 speed - omega are whirl frequencies."""
    partner = 2 * speed - omega

    def whirl(w):
        """H, f_n and the partials of f_n by w and by the speed."""
        h, g = 1 - w**2, delta - w**2 + beta * speed * w
        return h, h * g - gamma**2, -2 * w * g + h * (beta * speed - 2 * w), h * beta * w

    h, f, by_omega, by_speed = whirl(omega)
    h_bar, f_bar, by_partner, by_speed_alone = whirl(partner)
    assert abs(f) < mpf(10) ** -50 and abs(f_bar) < mpf(10) ** -50
    bar_by_omega, bar_by_speed = -by_partner, 2 * by_partner + by_speed_alone
    theta_1 = e1 * gamma**2 - e12 * gamma**2 * (h + h_bar) + e2 * delta * h * h_bar
    theta_2 = asymmetry * omega * partner * h * h_bar
    excitation = theta_1**2 + theta_2**2 + 2 * theta_1 * theta_2 * cos(2 * angle)
    radicand = -excitation / (h * h_bar) / (by_omega * bar_by_omega)
    return 4 * sqrt(radicand) / abs(bar_by_speed / bar_by_omega - by_speed / by_omega)


def widths(model, edge, inputs):
    mass, inertia, polar, asymmetry, disk, length, radius, modulus, poisson, depth, crack, angle = inputs
    mean, variation = stiffness(model, edge, disk, length, radius, modulus, poisson, depth, crack)
    beta = polar / inertia
    gamma = mean[1] / mean[0] * sqrt(mass / inertia)
    delta = mean[2] / mean[0] * mass / inertia
    dimensionless = (beta, gamma, delta, *(v / k for v, k in zip(variation, mean)), asymmetry, angle)
    reserve = delta - gamma**2
    q = beta - 1 - delta
    simple = sqrt(2 * reserve / (sqrt(q**2 + 4 * (beta - 1) * reserve) - q))
    root = sqrt(beta**2 + 8 * (2 - beta) * reserve)
    combination = sqrt(beta**2 + 4 * (2 - beta) * (1 + delta) + (4 - beta) * root) / (sqrt(mpf(8)) * (2 - beta))
    product = (beta + root) / (2 * (2 - beta))
    omega = combination + sqrt(combination**2 - product)
    return width(simple, simple, *dimensionless), width(omega, combination, *dimensionless)


def partials(model, edge, inputs):
    """Of both widths by every input."""
    for place, value in enumerate(inputs):
        step = abs(value) * STEP
        above, below = (
            widths(model, edge, [*inputs[:place], moved, *inputs[place + 1 :]]) for moved in (value + step, value - step)
        )
        yield [(a - b) / (2 * step) for a, b in zip(above, below)]


# Half as many nodes give the same digits.
for coarse, fine in zip(integrals(mpf("0.7"), OUTER - 1, INNER - 1), integrals(mpf("0.7"))):
    assert abs(coarse / fine - 1) < mpf(10) ** -42, abs(coarse / fine - 1)

with open("width_gradients.csv", "w", encoding="ascii") as table:
    names = [f"{region}_width{by}" for by in ("", *(f"_by_{name}" for name in INPUTS)) for region in ("sir", "cir")]
    table.write(",".join([*INPUTS, "crack_model", "crack_edge", *names]) + "\n")
    for text, crack_model, crack_edge in ROTORS:
        rotor = [mpf(cell) for cell in text.split()]
        factor = {"half": 32, "full": 64}[crack_edge]
        rows = [widths(crack_model, factor, rotor), *partials(crack_model, factor, rotor)]
        cells = [nstr(number, 20, min_fixed=0, max_fixed=0) for row in rows for number in row]
        table.write(",".join([*text.split(), crack_model, crack_edge, *cells]) + "\n")
