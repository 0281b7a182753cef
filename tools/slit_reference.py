#!/usr/bin/env python3
"""Reference temperatures of a square with an insulated slit while it warms up, by finite elements of high degree.

Usage: slit_reference.py (needs numpy and scipy; takes less than a minute)

The square [-1, 1]^2 with the insulated slit |x| < 1/2, y = 0, insulated at x = +-1, held at +-100 at y = +-1, starts
at 0; the diffusivity is 1. T is odd in y and even in x, which leaves the quarter [0, 1]^2 with T = 0 on y = 0 beside the
slit. Elements are products of polynomials through Gauss-Lobatto points, their edges graded geometrically towards the tip.
Laplace's transform in time is inverted along Talbot's contour, so that time adds no error that matters. The first of
three discretisations, which differ in degree, number of elements and grading, is the reference; the others stand as
differences from it, and its steady state is compared with the exact one (docs/theory/exact_solutions.md). That and the
second show that its values are right to 5e-5.
"""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
import scipy.sparse as sparse
from numpy.polynomial.legendre import Legendre, leggauss
from scipy.sparse.linalg import splu

TIP = 0.5
PROBES = [(0.0, 0.1), (0.0, 0.25), (0.0, 0.5), (0.0, 0.75), (1.0, 0.25), (1.0, 0.5)]
EXACT_STEADY = [46.74856365, 51.18306506, 64.43973878, 81.51784864, 28.38236246, 54.14751796]
TIMES = [0.1, 0.5]


def lobatto_points(degree):
    inner = Legendre.basis(degree).deriv().roots()
    return np.concatenate([[-1.0], np.sort(inner.real), [1.0]])


def element_matrices(degree):
    """Stiffness and mass of an element of length 2."""
    points = lobatto_points(degree)
    nodes, weights = leggauss(degree + 1)
    coefficients = np.linalg.inv(np.vander(points, increasing=True))
    values = np.vander(nodes, degree + 1, increasing=True) @ coefficients
    powers = np.arange(1, degree + 1)
    slopes = (np.vander(nodes, degree, increasing=True) * powers) @ coefficients[1:]
    return slopes.T @ (weights[:, None] * slopes), values.T @ (weights[:, None] * values)


def line_matrices(edges, degree):
    """Points, stiffness and mass of elements in a row."""
    stiffness, mass = element_matrices(degree)
    count = (len(edges) - 1) * degree + 1
    points = np.zeros(count)
    entries = {"row": [], "column": [], "stiffness": [], "mass": []}
    for k, (low, high) in enumerate(zip(edges[:-1], edges[1:])):
        own = k * degree + np.arange(degree + 1)
        half = 0.5 * (high - low)
        points[own] = low + half * (lobatto_points(degree) + 1.0)
        row, column = np.meshgrid(own, own, indexing="ij")
        for name, part in (("row", row), ("column", column), ("stiffness", stiffness / half), ("mass", mass * half)):
            entries[name].append(part.ravel())
    row, column, stiffness, mass = (np.concatenate(part) for part in entries.values())
    assemble = lambda data: sparse.csr_matrix((data, (row, column)), shape=(count, count))
    points[::degree] = edges
    return points, assemble(stiffness), assemble(mass)


def graded(length, ratio, layers):
    """Distances from the tip, up to `length`."""
    return np.concatenate([[0.0], length * ratio ** np.arange(layers, -1.0, -1.0)])


class QuarterSquare:
    def __init__(self, degree, ratio, layers, pieces):
        x_edges = np.concatenate([TIP - graded(TIP, ratio, layers)[::-1], TIP + graded(TIP, ratio, layers)[1:]])
        stops = [0.1, 0.25, 0.5, 0.75, 1.0]
        above = [np.linspace(low, high, pieces + 1)[1:] for low, high in zip(stops[:-1], stops[1:])]
        y_edges = np.concatenate([graded(0.1, ratio, layers), *above])
        self.x, x_stiffness, x_mass = line_matrices(x_edges, degree)
        self.y, y_stiffness, y_mass = line_matrices(y_edges, degree)
        self.stiffness = (sparse.kron(x_stiffness, y_mass) + sparse.kron(x_mass, y_stiffness)).tocsr()
        self.mass = sparse.kron(x_mass, y_mass).tocsr()
        place_x, place_y = (part.ravel() for part in np.meshgrid(self.x, self.y, indexing="ij"))
        top = place_y == 1.0
        held = top | ((place_y == 0.0) & (place_x >= TIP))
        self.free = np.flatnonzero(~held)
        self.top = np.flatnonzero(top)
        column = {point: k for k, point in enumerate(self.free)}
        near = [np.argmin(np.abs(place_x - x) + np.abs(place_y - y)) for x, y in PROBES]
        self.probes = [column[point] for point in near]

    def transform(self, p):
        """Temperatures at the probes for T = 1 at the top in the transform, p M T + K T = 0 elsewhere."""
        operator = (self.stiffness + p * self.mass)[self.free]
        source = -np.asarray(operator[:, self.top].sum(axis=1)).ravel()
        return splu(operator[:, self.free].tocsc(), permc_spec="MMD_AT_PLUS_A").solve(source)[self.probes]

    def warmed(self, time, points=20):
        """Temperatures after a step of 100 at the top, on the contour of Trefethen, Weideman, Schmelzer, BIT 46 (2006)."""
        angles = (2.0 * np.arange(points // 2) + 1.0) * np.pi / points
        turned = 0.6407 * angles
        contour = points * (0.5017 * angles / np.tan(turned) - 0.6122 + 0.2645j * angles)
        slope = points * (0.5017 / np.tan(turned) - 0.5017 * turned / np.sin(turned) ** 2 + 0.2645j)
        values = [np.exp(z) * dz * self.transform(z / time) / z for z, dz in zip(contour, slope)]
        return 100.0 * 2.0 / points * np.sum(values, axis=0).imag


def main():
    squares = [QuarterSquare(8, 0.2, 10, 1), QuarterSquare(6, 0.3, 14, 2), QuarterSquare(3, 0.5, 18, 4)]
    print("probes              " + "".join(f"({x:.0f}, {y:.2f})   " for x, y in PROBES))
    steady = [100.0 * square.transform(0.0) for square in squares]
    print("steady              " + " ".join(f"{value:11.6f}" for value in steady[0]))
    print("  exact - this      " + " ".join(f"{value:11.1e}" for value in EXACT_STEADY - steady[0]))
    for time in TIMES:
        first, *others = (square.warmed(time) for square in squares)
        print(f"t = {time}             " + " ".join(f"{value:11.6f}" for value in first))
        for other in others:
            print("  other elements    " + " ".join(f"{value:11.1e}" for value in other - first))
        print("  other contour     " + " ".join(f"{value:11.1e}" for value in squares[0].warmed(time, 16) - first))


if __name__ == "__main__":
    main()
