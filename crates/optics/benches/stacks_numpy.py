"""Stack evaluations per second in numpy, beside `cargo bench -p pellicle-optics`: the same stacks, one evaluation being R and T of
one stack at one wavelength, angle and polarization.

    pip install numpy            (tmm and tmm_fast are measured too where they are installed)
    python crates/optics/benches/stacks_numpy.py [--layers 1 5 21] [--seconds 1]

The plain way: Rouard's recursion from the substrate up on arrays [angle, wavelength], s and p in turn; the complex cosines of a
medium are computed once per medium.
"""
import argparse
import time

import numpy as np

WAVELENGTHS = 380.0 + 5.0 * np.arange(81)
DEGREES = np.arange(90.0)


def stack_of(layers, k=0.0):
    """Indices of the two media of the layers and of the substrate over the wavelengths, and the thicknesses."""
    cauchy = lambda a, b, k: a + b * 1e6 / WAVELENGTHS**2 + 1j * k
    media = [cauchy(1.45, 0.0035, 0.0), cauchy(2.25, 0.03, k), cauchy(1.505, 0.0042, 0.0)]
    i = np.arange(layers)
    return media, i % 2, 40.0 + (i * 7919 % 1000) * 0.08


def evaluate(media, order, thickness_nm, wavelengths, cosines):
    """R and T for s and p: four arrays [angle, wavelength]."""
    sine2 = (1.0 - cosines**2)[:, None]
    normal = [np.sqrt(n * n - sine2) for n in media]
    found = []
    for polarization in "sp":
        eta = [q if polarization == "s" else q / (n * n) for q, n in zip(normal, media)]
        below, r, t = eta[2], None, None
        for medium, d in zip(order[::-1], thickness_nm[::-1]):
            here = eta[medium]
            boundary = (here - below) / (here + below)
            passing = 2.0 * here / (here + below)
            if r is None:
                r, t = boundary, passing
            else:
                divisor = 1.0 + boundary * r
                r, t = (boundary + r) / divisor, passing * t / divisor
            beta = np.exp(2j * np.pi * d / wavelengths * normal[medium])
            r, t = r * beta * beta, t * beta
            below = here
        here = cosines[:, None]
        boundary, passing = (here - below) / (here + below), 2.0 * here / (here + below)
        divisor = 1.0 + boundary * r
        r, t = (boundary + r) / divisor, passing * t / divisor
        found += [np.abs(r) ** 2, np.abs(t) ** 2 * eta[2].real / here]
    return found


def evaluate_clear(media, order, thickness_nm, wavelengths, cosines):
    """The same where nothing absorbs: Abelès' matrices with real elements, by real arithmetic alone."""
    sine2 = (1.0 - cosines**2)[:, None]
    normal = [np.sqrt(n.real**2 - sine2) for n in media]
    waves = [2.0 * np.pi / wavelengths * q for q in normal]
    eta = {"s": normal, "p": [q / n.real**2 for q, n in zip(normal, media)]}
    # U and V of the field, real and imaginary parts.
    field = {p: [np.ones_like(e[2]), np.zeros_like(e[2]), e[2], np.zeros_like(e[2])] for p, e in eta.items()}
    for medium, d in zip(order[::-1], thickness_nm[::-1]):
        delta = waves[medium] * d
        sin, cos = np.sin(delta), np.cos(delta)
        for p, (a, b, c, e) in field.items():
            over, times = sin / eta[p][medium], sin * eta[p][medium]
            field[p] = [cos * a + over * e, cos * b - over * c, cos * c + times * b, cos * e - times * a]
    found = []
    for p, (a, b, c, e) in field.items():
        here = cosines[:, None]
        divisor = 1.0 / ((here * a + c) ** 2 + (here * b + e) ** 2)
        found += [((here * a - c) ** 2 + (here * b - e) ** 2) * divisor, 4.0 * here * eta[p][2] * divisor]
    return found


def rate(call, evaluations, seconds):
    """Evaluations per second: the best of calls for so many seconds."""
    call()
    best, end = float("inf"), time.perf_counter() + seconds
    while time.perf_counter() < end:
        start = time.perf_counter()
        call()
        best = min(best, time.perf_counter() - start)
    return evaluations / best


def peers(layers, k):
    """Names and calls, each of which evaluates one stack, and how many evaluations that is."""
    media, order, thickness_nm = stack_of(layers, k)
    cosines = np.cos(np.deg2rad(DEGREES))
    grid = 2 * len(DEGREES) * len(WAVELENGTHS)
    yield "numpy, complex", lambda: evaluate(media, order, thickness_nm, WAVELENGTHS, cosines), grid
    if k == 0.0:
        yield "numpy, real", lambda: evaluate_clear(media, order, thickness_nm, WAVELENGTHS, cosines), grid
    try:
        from tmm import coh_tmm

        n = [1.0] + [media[m][34] for m in order] + [media[2][34]]
        d = [np.inf, *thickness_nm, np.inf]
        yield "tmm", lambda: [coh_tmm("s", n, d, 0.1 * i, 550.0) for i in range(10)], 10
    except ImportError:
        pass
    try:
        from tmm_fast import coh_tmm as fast

        n = np.array([[np.ones(81), *(media[m] for m in order), media[2]]])
        d = np.array([[np.inf, *thickness_nm, np.inf]])
        theta = np.deg2rad(DEGREES)
        yield "tmm_fast", lambda: [fast(p, n, d, theta, WAVELENGTHS) for p in "sp"], grid
    except ImportError:
        pass


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--layers", type=int, nargs="+", default=[1, 5, 21])
    parser.add_argument("--seconds", type=float, default=1.0)
    parser.add_argument("-k", type=float, default=0.0, help="extinction of the second medium")
    options = parser.parse_args()
    for layers in options.layers:
        media, order, thickness_nm = stack_of(layers)
        cosines = np.cos(np.deg2rad(DEGREES))
        both = [f(media, order, thickness_nm, WAVELENGTHS, cosines) for f in (evaluate, evaluate_clear)]
        assert np.max(np.abs(np.array(both[0]) - np.array(both[1]))) < 1e-11
        for name, call, evaluations in peers(layers, options.k):
            print(f"{layers:3} layers  {name:15} {rate(call, evaluations, options.seconds):9.3g} per second", flush=True)


if __name__ == "__main__":
    main()
