"""Writes growth_rates.csv: exact growth rates where roots nearly meet, in 50 decimal digits and more.

Each from the determinant of the 4 x 4 matrix of Eq. (18) as corrected (E7), as a polynomial in s = omega - Omega: a path
of its own from the definitions, with mpmath's polynomial roots. Inputs are the doubles that the table prints. Three groups:

flat     the paper's rotor with beta from 1.98 to 1.9999, speeds over the combination region and half a width beside it,
         and single higher speeds
negative random rotors at speeds where two squared offsets meet at a negative value: a few parts in 1e9 beside them
positive the same where they meet at a positive value: an end of a combination region

Run it with mpmath 1.3 in this folder: python3 growth_rates.py
"""

import random

from mpmath import cos, matrix, mp, mpc, mpf, nstr, polyroots, sin, sqrt

mp.dps = 55
NAMES = "beta gamma delta epsilon_1 epsilon_12 epsilon_2 disk_asymmetry crack_angle".split()


def times(a, b):
    product = [mpc(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            product[i + j] += x * y
    return product


def plus(a, b):
    size = max(len(a), len(b))
    return [(a[i] if i < len(a) else 0) + (b[i] if i < len(b) else 0) for i in range(size)]


def determinant(rows):
    if len(rows) == 1:
        return rows[0][0]
    total = [mpc(0)]
    for column, entry in enumerate(rows[0]):
        minor = [[row[k] for k in range(len(rows)) if k != column] for row in rows[1:]]
        sign = -1 if column % 2 else 1
        total = plus(total, [sign * x for x in times(entry, determinant(minor))])
    return total


def quartic(c, speed):
    """The determinant's coefficients of the powers of S = s**2, lowest first."""
    beta, gamma, delta, e1, e12, e2, asymmetry, angle = (mpf(x) for x in c)
    speed = mpf(speed)
    turn = mpc(cos(2 * angle), -sin(2 * angle))
    omega, partner = [speed, mpf(1)], [speed, mpf(-1)]

    def transverse(w):
        return plus([mpf(1)], [-x for x in times(w, w)])

    def tilting(w):
        return plus(plus([delta], [-x for x in times(w, w)]), [beta * speed * x for x in w])

    disk = [asymmetry * x for x in times(omega, partner)]
    b11, b12, b22 = [turn * e1], [turn * e12 * gamma], plus([turn * e2 * delta], disk)
    c11, c12 = [turn.conjugate() * e1], [turn.conjugate() * e12 * gamma]
    c22 = plus([turn.conjugate() * e2 * delta], disk)
    g = [gamma]
    powers = determinant([
        [transverse(omega), g, b11, b12],
        [g, tilting(omega), b12, b22],
        [c11, c12, transverse(partner), g],
        [c12, c22, g, tilting(partner)],
    ])
    return [powers[2 * k].real for k in range(5)]


def squared_offsets(c, speed):
    """The four roots S."""
    return polyroots(quartic(c, speed)[::-1], maxsteps=500, extraprec=150)


def growth(c, speed):
    # A root's imaginary part is rounding below 1e-45 of it: roots here are never nearer to each other.
    return max(abs(sqrt(s).imag) if abs(s.imag) > mpf(10) ** -40 * abs(s) else sqrt(max(-s.real, 0))
               for s in squared_offsets(c, speed))


def complex_ones(c, speed):
    return [s for s in squared_offsets(c, speed) if abs(s.imag) > mpf(10) ** -20 * abs(s)]


PAPER = [1.5, -0.9123512396120258, 1.558734262038765, 0.10441394507909169, 0.1312564024578105, 0.08811183080785835, 0.2, 0.0]


def flat():
    for beta in (1.98, 1.993, 1.999, 1.9999):
        c = [beta] + PAPER[1:]
        slack, reserve = 2 - mpf(beta), mpf(c[2]) - mpf(c[1]) ** 2
        root = sqrt(mpf(beta) ** 2 + 8 * slack * reserve)
        start = float(sqrt((mpf(beta) ** 2 + 4 * slack * (1 + c[2]) + (4 - beta) * root) / 8) / slack)
        for part in range(-8, 9):
            yield "flat", c, start * (1 + 0.018 * part)
        for speed in (1.0, 50.0, 1e4):
            yield "flat", c, speed
    c = [1.999] + PAPER[1:]
    for speed in (960.5849927114625, 954.6370039):
        yield "flat", c, speed
    yield "flat", [1.993] + PAPER[1:], 136.996


def meetings():
    """Speeds at which the number of complex roots changes, of random rotors, with the place of the meeting."""
    source = random.Random(9)
    found = {"negative": 0, "positive": 0}
    while min(found.values()) < 5:
        gamma = source.uniform(-1.2, 1.2)
        c = [source.uniform(0.05, 1.95), gamma, gamma ** 2 + source.uniform(0.05, 1.5)]
        c += [source.uniform(-0.4, 0.4) for _ in range(3)] + [source.uniform(-0.5, 0.5), source.uniform(-3, 3)]
        speeds = [0.4 * 1.12 ** k for k in range(18)]
        with mp.workdps(30):
            counts = [len(complex_ones(c, speed)) for speed in speeds]
        for k in range(17):
            if counts[k] == counts[k + 1]:
                continue
            low, high = mpf(speeds[k]), mpf(speeds[k + 1])
            with mp.workdps(35):
                for _ in range(52):
                    middle = (low + high) / 2
                    if len(complex_ones(c, middle)) == counts[k]:
                        low = middle
                    else:
                        high = middle
            more = low if counts[k] > counts[k + 1] else high
            meeting = min(complex_ones(c, more), key=lambda s: abs(s.imag)).real
            kind = "negative" if meeting < 0 else "positive"
            if found[kind] < 5:
                found[kind] += 1
                for apart in (-1e-6, -1e-9, -1e-12, 1e-12, 1e-9, 1e-6):
                    yield kind, c, float(low * (1 + apart))


def main():
    with open("growth_rates.csv", "w", encoding="utf-8", newline="\n") as file:
        print("group", *NAMES, "speed", "growth_rate", sep=",", file=file)
        for source in (flat(), meetings()):
            for group, c, speed in source:
                print(group, *map(repr, c), repr(speed), nstr(growth(c, speed), 20), sep=",", file=file)


if __name__ == "__main__":
    main()
