"""Derives the constants of server/physics/geometry/trigonometry.* (needs mpmath; prints C++).

Polynomials: Remez exchange in 60 digits, weighted so that the error of the whole function (relative for the sine and
the arc tangent, absolute for the cosine) is level; then rounded to the scalar.
"""

from mpmath import mp, mpf, atan, cos, pi, sin, sqrt, matrix, lu_solve, floor, log

mp.dps = 60


def remez(function, weight, low, high, degree):
    """The coefficients c of a polynomial that minimises max |weight(z) · (c(z) − function(z))| over [low, high]."""
    count = degree + 2
    nodes = [(low + high) / 2 - (high - low) / 2 * mp.cos(pi * (2 * k + 1) / (2 * count)) for k in range(count)]
    grid = [low + (high - low) * mpf(k) / 2000 for k in range(1, 2001)]
    values = [function(z) for z in grid]
    weights = [weight(z) for z in grid]
    for _ in range(12):
        a = matrix(count, count)
        b = matrix(count, 1)
        for i, z in enumerate(nodes):
            for j in range(degree + 1):
                a[i, j] = z**j
            a[i, degree + 1] = (-1) ** i / weight(z)
            b[i] = function(z)
        solution = lu_solve(a, b)
        c = [solution[j] for j in range(degree + 1)]
        error = [w * (mp.polyval(c[::-1], z) - f) for z, f, w in zip(grid, values, weights)]
        peaks, start = [], 0
        for k in range(1, len(grid) + 1):
            if k == len(grid) or error[k] * error[k - 1] < 0:
                peaks.append(max(range(start, k), key=lambda i: abs(error[i])))
                start = k
        if len(peaks) < count:
            break
        while len(peaks) > count:
            peaks.pop(0 if abs(error[peaks[0]]) < abs(error[peaks[-1]]) else -1)
        nodes = [grid[k] for k in peaks]
    return c, max(abs(e) for e in error)


def truncated(value, bits):
    """value cut to its leading bits."""
    exponent = int(floor(log(abs(value), 2)))
    scale = mpf(2) ** (bits - 1 - exponent)
    return floor(value * scale) / scale


def sine(degree, high):
    return remez(lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, mpf(0) + mpf(10) ** -9, high, degree)


def cosine(degree, high):
    def series(z):
        return sum((-1) ** (k + 2) * z**k / mp.factorial(2 * k + 4) for k in range(30))

    return remez(series, lambda z: z * z, mpf(10) ** -9, high, degree)


def arc_tangent(degree, high):
    return remez(lambda z: (atan(sqrt(z)) / sqrt(z) - 1) / z, lambda z: z, mpf(10) ** -9, high, degree)


def show(name, result):
    c, error = result
    print(f"// {name}: error 2^{float(log(error, 2)):.1f}")
    print(",\n".join(f"  {float(k).hex()} /* {float(k)!r} */" for k in c))


def show_parts(name, value, bits, count):
    for k in range(count):
        part = truncated(value, bits) if k + 1 < count else mpf(float(value))
        print(f"{name}_{k + 1} = {float(part).hex()};  // {float(part)!r}")
        value -= part


if __name__ == "__main__":
    octant = (pi / 4 * (1 + mpf(10) ** -6)) ** 2
    show("sine, double", sine(5, octant))
    show("cosine, double", cosine(5, octant))
    show("sine, float", sine(2, octant))
    show("cosine, float", cosine(2, octant))
    show("arc tangent, double", arc_tangent(10, mpf("0.4376") ** 2))
    show("arc tangent, float", arc_tangent(5, mpf("0.4376") ** 2))
    show_parts("half_pi", pi / 2, 33, 4)
    show_parts("two_pi", 2 * pi, 33, 4)
    print("two_over_pi", float(2 / pi).hex(), "half_over_pi", float(1 / (2 * pi)).hex())
    for name, base in (("0", mpf(0)), ("atan half", atan(mpf(1) / 2)), ("quarter pi", pi / 4)):
        for value in (base, pi / 2 - base, pi - base, pi / 2 + base):
            high = mpf(float(value))
            print(name, float(high).hex(), float(value - high).hex())
