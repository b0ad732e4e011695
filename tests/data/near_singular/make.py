#!/usr/bin/env python3
"""Makes near_singular.json: energy densities with stress and Hessian for deformation gradients that are nearly singular, inverted or
extreme. Only psi is written down; its derivatives are central differences in 120 digits, good to 30. E = 1e6, nu = 0.3."""
import json
from decimal import Decimal, getcontext
from itertools import product

getcontext().prec = 120
MU, LAMBDA = Decimal(10**6) / Decimal("2.6"), Decimal(300000) / (Decimal("1.3") * Decimal("0.4"))
STEP = Decimal(10) ** -25


def invariants(F):
    a, b, c, d, e, f, g, h, i = F
    return sum(x * x for x in F), a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def neo_hookean(F):
    I, J = invariants(F)
    return MU / 2 * (I * (J.ln() * -2 / 3).exp() - 3) + LAMBDA / 2 * (J - 1) ** 2


def stable_neo_hookean(F):
    I, J = invariants(F)
    return MU / 2 * (I - 3) - MU * (J - 1) + (LAMBDA + MU) / 2 * (J - 1) ** 2


def stable_neo_hookean_log(F):
    m, l = MU * 4 / 3, LAMBDA + MU * 5 / 6
    a = 1 + m / l - m / (4 * l)

    def psi(I, J):
        return m / 2 * (I - 3) + l / 2 * (J - a) ** 2 - m / 2 * (I + 1).ln()

    return psi(*invariants(F)) - psi(Decimal(3), Decimal(1))


def neo_hookean_log(F):
    I, J = invariants(F)
    return MU / 2 * (I - 3) - MU * J.ln() + LAMBDA / 2 * J.ln() ** 2


def second_invariant(F):
    """|cof F|^2 = ((tr C)^2 - tr C^2)/2."""
    C = [sum(F[3 * k + i] * F[3 * k + j] for k in range(3)) for i in range(3) for j in range(3)]
    return ((C[0] + C[4] + C[8]) ** 2 - sum(x * x for x in C)) / 2


def mooney_rivlin(F):
    I, J = invariants(F)
    root = (J.ln() * -2 / 3).exp()
    bulk = LAMBDA + MU * 2 / 3
    return MU * 4 / 10 * (I * root - 3) + MU / 10 * (second_invariant(F) * root**2 - 3) + bulk / 2 * (J - 1) ** 2


def st_venant_kirchhoff(F):
    E = [(sum(F[3 * k + i] * F[3 * k + j] for k in range(3)) - (i == j)) / 2 for i in range(3) for j in range(3)]
    return MU * sum(x * x for x in E) + LAMBDA / 2 * (E[0] + E[4] + E[8]) ** 2


def sum_of_stretches(F):
    """s1 + s2 + s3, the last with the sign of J: the largest root of (t^2 - I)^2 = 4 (II + 2 J t), by Newton from above."""
    I, J = invariants(F)
    II = second_invariant(F)
    t = (3 * I).sqrt()
    while True:
        step = ((t * t - I) ** 2 - 4 * (II + 2 * J * t)) / (4 * t * (t * t - I) - 8 * J)
        t -= step
        if abs(step) < t * Decimal(10) ** -110:
            return t


def arap(F):
    return MU * (invariants(F)[0] - 2 * sum_of_stretches(F) + 3)


def corotated(F):
    return arap(F) + LAMBDA / 2 * (sum_of_stretches(F) - 3) ** 2


def fixed_corotated(F):
    return arap(F) + LAMBDA / 2 * (invariants(F)[1] - 1) ** 2


def linear(F):
    e = [(F[3 * i + j] + F[3 * j + i]) / 2 - (i == j) for i in range(3) for j in range(3)]
    return MU * sum(x * x for x in e) + LAMBDA / 2 * (e[0] + e[4] + e[8]) ** 2


PSI = [neo_hookean, stable_neo_hookean, stable_neo_hookean_log, neo_hookean_log, mooney_rivlin, st_venant_kirchhoff, arap, corotated,
       fixed_corotated, linear]


def moved(F, *steps):
    F = list(F)
    for k, step in steps:
        F[k] += step
    return F


def derivatives(psi, F):
    def first(k):
        return (psi(moved(F, (k, STEP))) - psi(moved(F, (k, -STEP)))) / (2 * STEP)

    def second(k, l):
        return sum(s * t * psi(moved(F, (k, s * STEP), (l, t * STEP))) for s, t in product((1, -1), repeat=2)) / (4 * STEP**2)

    H = {(k, l): second(k, l) for k in range(9) for l in range(k, 9)}
    return {
        "psi": float(psi(F)),
        "P": [float(first(k)) for k in range(9)],
        "H": [float(H[min(k, l), max(k, l)]) for k in range(9) for l in range(9)],
    }


def times(A, B):
    return [sum(A[3 * i + k] * B[3 * k + j] for k in range(3)) for i in range(3) for j in range(3)]


# Integer matrices: U diag V is exact in double precision where the diagonal holds powers of two.
U = [3, 2, 4, 7, 5, 9, 1, 1, 3]
V = [2, 3, 1, 5, 8, 3, 4, 6, 3]
CASES = {
    "nearly_flat": times(times(U, [1, 0, 0, 0, 1, 0, 0, 0, 2.0**-10]), V),
    "flat_to_1e-6": times(times(U, [1, 0, 0, 0, 1, 0, 0, 0, 2.0**-20]), V),
    "flat_to_1e-12": times(times(U, [1, 0, 0, 0, 1, 0, 0, 0, 2.0**-40]), V),
    "needle": times(times(U, [1, 0, 0, 0, 2.0**-15, 0, 0, 0, 2.0**-17]), V),
    "shrunk": [2.0**-12 * x for x in U],
    "stretched": [2.0**12 * x for x in V],
    "inverted": [-1.1, 0.2, 0.1, 0.3, 0.9, -0.2, 0.1, 0.0, 1.2],
    "nearly_inverted_flat": [1.0, 0.1, 0.2, 0.3, 0.9, -0.2, 1.3, 1.0, -2.0**-30],
    "nearly_identity": [1 + 2.0**-30, 2.0**-31, 0, -(2.0**-32), 1, 2.0**-30, 0, 0, 1 - 2.0**-29],
}

result = {}
for name, F in CASES.items():
    exact = [Decimal(x) for x in F]
    J = invariants(exact)[1]
    models = {}
    for psi in PSI:
        if psi not in (neo_hookean, neo_hookean_log, mooney_rivlin) or J > 0:
            models[psi.__name__] = derivatives(psi, exact)
    result[name] = {"F": [float(x) for x in F], "J": float(J), "models": models}
with open("near_singular.json", "w") as out:
    json.dump(result, out, indent=1)
