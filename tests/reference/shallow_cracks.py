"""Writes shallow_cracks.csv: crack compliance and stiffness variations of the paper's rotor with a shallow crack.

Straight from the definitions, Eqs. (6) to (8), (10) and (12) with the corrections E3 to E5, in 40 decimal digits: the
double integrals by nested Gauss-Legendre quadrature, the stiffness as the plain difference of two inverse matrices,
which loses digits that 40 can spare. Run it with mpmath 1.3 in this folder: python3 shallow_cracks.py
"""

from mpmath import cos, matrix, mp, mpf, nstr, pi, quad, sin, sqrt, tan

mp.dps = 40

MASS, INERTIA = mpf("10.43"), mpf("0.1397")
LENGTH, RADIUS = mpf("0.5045"), mpf("0.01188")
MODULUS, POISSON = mpf("2.0e11"), mpf("0.3")
DISK, CRACK = mpf("0.25"), mpf("0.5")


def tada(alpha):
    l = pi * alpha / 2
    return sqrt(tan(l) / l)


def opening(alpha):
    l = pi * alpha / 2
    return tada(alpha) * (mpf("0.923") + mpf("0.199") * (1 - sin(l)) ** 4) / cos(l)


def lateral(alpha):
    l = pi * alpha / 2
    return tada(alpha) * (mpf("0.752") + mpf("2.02") * alpha + mpf("0.37") * (1 - sin(l)) ** 3) / cos(l)


def sliding(alpha):
    polynomial = mpf("1.122") - mpf("0.561") * alpha + mpf("0.085") * alpha**2 + mpf("0.18") * alpha**3
    return polynomial / sqrt(1 - alpha)


def integral(sigma, weight, factor):
    """The double integral over the crack's face of weight(mu) * xi * factor(xi / h)^2."""
    half_width = sqrt(1 - (1 - sigma) ** 2)

    def strip(mu):
        height = 2 * sqrt(1 - mu**2)
        depth = sqrt(1 - mu**2) - (1 - sigma)
        return weight(mu) * quad(lambda xi: xi * factor(xi / height) ** 2, [0, depth], method="gauss-legendre")

    return quad(strip, [0, half_width], method="gauss-legendre")


def compliance(sigma):
    plane = (1 - POISSON**2) / (pi * MODULUS * RADIUS)
    bending = plane / RADIUS**2
    return (
        4 * plane * integral(sigma, lambda mu: 1, sliding),
        4 * plane * integral(sigma, lambda mu: 1, tada),
        64 * bending * integral(sigma, lambda mu: 1 - mu**2, opening),
        32 * bending * integral(sigma, lambda mu: mu**2, lateral),
    )


def loads(model):
    """Moment and shear at the crack, of a unit force and of a unit couple at the disk."""
    if model == "support-arm":
        return -CRACK * LENGTH, mpf(1), mpf(1), mpf(0)
    if model == "midspan-arm":
        return (mpf("0.5") - CRACK) * LENGTH, mpf(1), mpf(1), mpf(0)
    return DISK * (1 - CRACK) * LENGTH, -DISK, 1 - CRACK, -1 / LENGTH


def variations(model, c11, c22, c33, c44):
    second_moment = pi * RADIUS**4 / 4
    left, right = DISK * LENGTH, (1 - DISK) * LENGTH
    f11 = (left * right) ** 2 / (3 * MODULUS * second_moment * LENGTH)
    f44 = (left**3 + right**3) / (3 * MODULUS * second_moment * LENGTH**2)
    f14 = left * right * (LENGTH - 2 * left) / (3 * MODULUS * second_moment * LENGTH)
    moment_f, shear_f, moment_m, shear_m = loads(model)

    def stiffness(shear, bending):
        a11 = f11 + shear * shear_f**2 + bending * moment_f**2
        a14 = f14 + shear * shear_f * shear_m + bending * moment_f * moment_m
        a44 = f44 + shear * shear_m**2 + bending * moment_m**2
        return matrix([[a11, a14], [a14, a44]]) ** -1

    first, second = stiffness(c11, c44), stiffness(c22, c33)
    return [(first[i, j] - second[i, j]) / (first[i, j] + second[i, j]) for i, j in ((0, 0), (0, 1), (1, 1))]


with open("shallow_cracks.csv", "w", encoding="ascii") as table:
    table.write("crack_depth_ratio,crack_model,c11,c22,c33,c44,epsilon_1,epsilon_12,epsilon_2\n")
    for depth in ("0.005", "0.01", "0.02", "0.05"):
        compliances = compliance(mpf(depth))
        for model in ("support-arm", "midspan-arm", "simply-supported"):
            numbers = [*compliances, *variations(model, *compliances)]
            cells = [nstr(number, 20, min_fixed=0, max_fixed=0) for number in numbers]
            table.write(",".join([depth, model, *cells]) + "\n")
