"""Writes flat_disk_ends.csv: exact ends of the combination region of the paper's rotor with beta just below 2.

The ends are where complex squared offsets appear near the start of Eq. (16). By bisection of the speed in 130 digits, since all four offsets agree in up to 15 of them. Run it with mpmath 1.3 in this
folder: python3 flat_disk_ends.py
"""

from growth_rates import NAMES, PAPER, quartic
from mpmath import binomial, mp, mpf, nstr, polyroots, sqrt

mp.dps = 130


def unstable(c, speed):
    # The offsets S themselves are a cluster that no root finder takes apart: (S - speed**2) / speed are well apart.
    powers = quartic(c, speed)
    shifted = [
        speed ** k * sum(binomial(n, k) * powers[n] * speed ** (2 * (n - k)) for n in range(k, 5)) for k in range(5)
    ]
    roots = polyroots(shifted[::-1], maxsteps=500, extraprec=150)
    return any(abs(root.imag) > mpf(10) ** -30 * abs(root) for root in roots)


def main():
    with open("flat_disk_ends.csv", "w", encoding="utf-8", newline="\n") as file:
        print(*NAMES, "lower", "upper", sep=",", file=file)
        for slack in (2.0 ** -10, 2.0 ** -20, 2.0 ** -24, 2.0 ** -40, 2.0 ** -49):
            for angle in (0.0, 0.5, 1.5):
                c = [2.0 - slack] + PAPER[1:-1] + [angle]
                t, reserve = mpf(slack), mpf(c[2]) - mpf(c[1]) ** 2
                root = sqrt((2 - t) ** 2 + 8 * t * reserve)
                start = sqrt(((2 - t) ** 2 + 4 * t * (1 + c[2]) + (2 + t) * root) / 8) / t
                ends = []
                # Near beta = 2 terms of second order in the asymmetries move the region off its start by some percent.
                center = next(
                    start * (1 + side * mpf(k) / 1000)
                    for k in range(200)
                    for side in (-1, 1)
                    if unstable(c, start * (1 + side * mpf(k) / 1000))
                )
                for side in (-1, 1):
                    inside, outside = center, center * mpf("1.3") ** side
                    assert unstable(c, inside) and not unstable(c, outside)
                    for _ in range(62):
                        middle = (inside + outside) / 2
                        if unstable(c, middle):
                            inside = middle
                        else:
                            outside = middle
                    ends.append(nstr(inside, 20))
                print(*map(repr, c), *ends, sep=",", file=file)


if __name__ == "__main__":
    main()
