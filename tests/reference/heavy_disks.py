"""Writes heavy_disks.csv: start, width and closing asymmetry of the simple region of disks with much inertia for their mass.

Eqs. (15), (25), (31) and (32) as printed (E9) in 60 digits, from the coefficients of the paper's rotor with both inertias
so many times as large. Run it with mpmath 1.3 in this folder: python3 heavy_disks.py
"""

from growth_rates import NAMES, PAPER
from mpmath import cos, mp, mpf, nstr, sqrt

mp.dps = 60


def simple_region(beta, gamma, delta, e1, e12, e2, asymmetry, angle):
    """Start, width, and the asymmetry that closes the region at pi/2."""
    reserve, q = delta - gamma**2, beta - 1 - delta
    speed = sqrt(2 * reserve / (sqrt(q**2 + 4 * (beta - 1) * reserve) - q))
    h, g = 1 - speed**2, delta + (beta - 1) * speed**2
    by_omega = -2 * speed * g + h * (beta - 2) * speed
    by_speed = h * beta * speed
    theta_1 = e1 * gamma**2 - 2 * e12 * gamma**2 * h + e2 * delta * h**2
    theta_2 = asymmetry * speed**2 * h**2
    excitation = theta_1**2 + theta_2**2 + 2 * theta_1 * theta_2 * cos(2 * angle)
    peak = sqrt(excitation / h**2 / by_omega**2)
    slope = (2 * by_omega + by_speed) / -by_omega - by_speed / by_omega
    return speed, 4 * peak / abs(slope), theta_1 / (speed * h) ** 2


def main():
    with open("heavy_disks.csv", "w", encoding="ascii") as table:
        print(*NAMES, "sir_start", "sir_width", "sir_zup_asymmetry", sep=",", file=table)
        for beta in (1.2, PAPER[0], 2.0):
            for power in (0, 1, 2, 3, 4, 6, 8, 10, 12):
                c = [beta, PAPER[1] / 10.0 ** (power / 2), PAPER[2] / 10.0**power, *PAPER[3:-1], 0.3]
                numbers = simple_region(*map(mpf, c))
                print(*map(repr, c), *(nstr(number, 20) for number in numbers), sep=",", file=table)


if __name__ == "__main__":
    main()
