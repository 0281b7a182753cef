#!/usr/bin/env python3
"""How far before its tip mirrored bonds of a crack must end: the share c of the horizon, from the equations of the grid.

Usage: tip_shift.py [--kernels linear,constant] [--exponents 2,1,0] [--dimensions 2,3] [--ratios 2,3,4] [--rim 6]
                    [--positions 8] [--sharpness 2]
(needs numpy and scipy; all rows take 25 minutes). For each kernel, exponent and dimension it prints a row of
src/peritherm/physics/tip_shift.cpp: c for each ratio m of horizon and spacing, and its limit for fine grids. Below each
row stand the spread of c over positions of the tip, and the limit as the last two ratios extrapolate it, with an error
like m^(-3/2), a power that fits and is not derived, and how much m^(-2) would change. docs/theory/tip_shift.md derives
the rest.

On the grid: a straight crack half way between two rows, T odd across its line, so that the points above it suffice.
Bonds that cross the line left of the tip are mirrored, those right of it are whole, and within half a spacing of the
tip, pulled back by c horizons, the share that is mirrored falls linearly. T = sqrt(r) sin(theta/2), the field of a
crack that ends in the tip itself, is held beyond `rim` horizons. With L the sum over bonds, T its solution and chi a
window that leaves out what the rim disturbs, M(c) = sum chi T L(sqrt(r) sin(theta/2)) is proportional to the part
sin(theta/2)/sqrt(r) of T far away, which is what a tip at another place would add. c is the root of M, averaged over
positions of the tip between two columns of points. A straight front along an axis of a 3-D grid is the same problem
with bonds summed along the front.

The limit: v(r) = sqrt(r) T(r) / sin(theta/2) obeys
    <(1/pi) int_{|r - l|}^{r + l} v(R) / sqrt(l^2 - (r - R)^2) dR - v(r)> = 0,  v -> r + c/2 far away, horizon 1,
where <> is the mean over the lengths l of bonds, projected onto the plane across the front.
"""

import argparse
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import cg

RATIOS = "2,3,4,5,6.5,9,13"


def shapes(sharpness):
    """The kernels of physics/kernel.hpp over s = length / horizon."""
    return {
        "constant": lambda s: np.ones_like(s),
        "linear": lambda s: 1.0 - s,
        "quadratic": lambda s: (1.0 - s * s) ** 2,
        "gaussian": lambda s: np.exp(-((sharpness * s) ** 2)),
    }


def counted_cells(distance, ratio):
    """Share of each cell that counts, and the distance at which the kernel is evaluated: Algorithm 1 of [bobaru2012]."""
    share = np.clip(ratio + 0.5 - distance, 0.0, 1.0)
    share[share <= 1e-9] = 0.0
    middle = np.where(distance <= ratio + 1e-9, distance - 0.5 * (1.0 - share), ratio - 0.5 * share)
    return share, np.where(distance < ratio - 0.5, distance, middle)


def stencil(shape, exponent, ratio, dimension):
    """Offsets (a along the crack, b across it) and conductances of a point's bonds, summed along the front in 3-D, with
    second moment 2 along each axis, as in discretisation/stencil.cpp."""
    reach = int(ratio + 0.5 + 1e-6)
    axis = np.arange(-reach, reach + 1)
    along_front = axis if dimension == 3 else np.array([0])
    a, b, z = (part.ravel().astype(float) for part in np.meshgrid(axis, axis, along_front, indexing="ij"))
    distance = np.sqrt(a * a + b * b + z * z)
    distance[distance == 0.0] = np.inf
    share, kernel_distance = counted_cells(distance, ratio)
    values = shape(np.where(share > 0.0, kernel_distance, 0.0) / ratio)
    weights = (values * share / distance**exponent).reshape(len(axis), len(axis), -1).sum(axis=2).ravel()
    a, b = (part.ravel() for part in np.meshgrid(axis, axis, indexing="ij"))
    kept = (weights > 0.0) & ((a != 0) | (b != 0))
    a, b, weights = a[kept], b[kept], weights[kept]
    return a, b, weights * 2.0 / np.sum(weights * a * a)


class TipPatch:
    """The points above the crack's line around a tip that lies `offset` spacings right of a column of points."""

    def __init__(self, bonds, ratio, offset, rim):
        a, b, weights = bonds
        reach = int(np.max(np.abs(a)))
        half = int(np.ceil(rim * ratio)) + reach + 1
        self.columns = 2 * half + 1
        x, y = np.meshgrid(np.arange(-half, half + 1) - offset, np.arange(half + 1) + 0.5)
        radius = np.hypot(x, y).ravel()
        self.mode = np.sqrt(radius) * np.sin(0.5 * np.arctan2(y, x)).ravel()
        self.free = np.flatnonzero(radius < rim * ratio)
        scaled = np.clip((radius[self.free] / ratio - 1.2) / (rim - 0.2 - 1.2), 0.0, 1.0)
        self.window = 1.0 - scaled**3 * (10.0 - scaled * (15.0 - 6.0 * scaled))
        self.total = np.sum(weights)
        self.ratio = ratio
        self._collect(a, b, weights, x, offset)

    def _collect(self, a, b, weights, x, offset):
        """Splits the bonds of the free points into those above the line and those that cross it."""
        row, column = np.divmod(self.free, self.columns)
        to_row = row[:, None] + b
        crosses = to_row < 0
        # A point below the line stands for its mirror image above, with the opposite sign.
        to = np.where(crosses, -1 - to_row, to_row) * self.columns + column[:, None] + a
        start = np.broadcast_to(np.arange(len(self.free))[:, None], to.shape)
        weight = np.broadcast_to(weights, to.shape)
        shape = (len(self.free), x.size)
        self.whole = sparse.csr_matrix((weight[~crosses], (start[~crosses], to[~crosses])), shape=shape)
        self.cut = (start[crosses], to[crosses])
        self.cut_weight = weight[crosses]
        point, bond = np.nonzero(crosses)
        where = (row[point] + 0.5) / -b[bond]
        self.crossing = x.ravel()[self.free[point]] + a[bond] * where

    def excess(self, shift):
        """M(c) with the tip of the mirrored bonds `shift` horizons left of the tip of the field."""
        mirrored = np.clip(0.5 - (self.crossing + shift * self.ratio), 0.0, 1.0)
        cut = sparse.csr_matrix((self.cut_weight * (2.0 * mirrored - 1.0), self.cut), shape=self.whole.shape)
        operator = self.whole + cut
        residual = operator @ self.mode - self.total * self.mode[self.free]
        inner = self.total * sparse.identity(len(self.free), format="csr") - operator[:, self.free]
        change, failed = cg(inner, residual, rtol=1e-9, atol=0.0, maxiter=2000)
        if failed:
            raise RuntimeError("conjugate gradients do not converge")
        return np.sum(self.window * (self.mode[self.free] + change) * residual)

    def shift(self, start):
        """The root of M by secants."""
        low, high = start, 1.05 * start
        at_low, at_high = self.excess(low), self.excess(high)
        for _ in range(8):
            low, high = high, high - at_high * (high - low) / (at_high - at_low)
            if abs(high - low) < 1e-5:
                break
            at_low, at_high = at_high, self.excess(high)
        return high


def grid_shift(shape, exponent, dimension, ratio, rim, positions):
    """Mean and spread of c over positions of the tip between two columns of points."""
    bonds = stencil(shape, exponent, ratio, dimension)
    start = closed_bound(np.hypot(bonds[0], bonds[1]) / ratio, bonds[2])
    shifts = [TipPatch(bonds, ratio, (k + 0.5) / positions, rim).shift(start) for k in range(positions)]
    return np.mean(shifts), np.ptp(shifts)


def closed_bound(lengths, weights):
    """<l^3> / (6 <l^2>) + <l^2> / (16 <l>): the greatest lower bound of the limit with v = r + constant."""
    first, second, third = (np.sum(weights * lengths**power) for power in (1, 2, 3))
    return third / (6.0 * second) + second / (16.0 * first)


def gauss(count, edges):
    """Gauss quadrature on the panels between `edges`."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    low, width = edges[:-1, None], np.diff(edges)[:, None]
    return (low + width * 0.5 * (nodes + 1.0)).ravel(), (width * 0.5 * weights).ravel()


def bond_lengths(shape, exponent, dimension):
    """Projected lengths of bonds and their weights, for a horizon of 1. kappa may be singular at 0: panels halve."""
    lengths, weights = gauss(12, np.concatenate([[0.0], 2.0 ** np.arange(-14.0, 0.5)]))
    weights = weights * shape(lengths) * lengths ** (dimension - 1 - exponent)
    if dimension == 3:
        angles, shares = gauss(12, np.array([0.0, 0.5 * np.pi]))
        lengths = np.outer(lengths, np.sin(angles)).ravel()
        weights = np.outer(weights, shares * np.sin(angles)).ravel()
    return lengths, weights


def half_line_shift(lengths, weights, count):
    """c of the equation of the limit, collocated with `count` straight pieces up to 3 horizons; second order."""
    rim = 3.0
    nodes = np.append(rim * (np.arange(count + 1) / count) ** 2, rim + 1.5)
    places = nodes[:-1].copy()
    places[0] = 0.1 * nodes[1]
    widths = np.diff(nodes)
    matrix = np.zeros((count + 1, count + 2))
    for row, place in zip(matrix, places):
        # In units of l: what is left of the near end of the integral, exactly -1 where l < r, has no weight.
        near = np.maximum(-1.0, 1.0 - 2.0 * place / lengths)[:, None]
        scaled = np.clip((nodes - place) / lengths[:, None], near, 1.0)
        zeroth = weights @ np.diff(np.arcsin(scaled), axis=1) / np.pi
        first = -(weights * lengths) @ np.diff(np.sqrt(1.0 - scaled * scaled), axis=1) / np.pi
        right = (first + (place - nodes[:-1]) * zeroth) / widths
        row[:-1] += zeroth - right
        row[1:] += right
    total = np.sum(weights)
    matrix[np.arange(count + 1), np.arange(count + 1)] -= total
    matrix[0, :2] += total * np.array([0.1, -0.1])
    # Beyond the rim v grows as r does.
    known = -1.5 * matrix[:, -1]
    matrix[:, -2] += matrix[:, -1]
    return 2.0 * (np.linalg.solve(matrix[:, :-1], known)[-1] - rim)


def limit_shift(shape, exponent, dimension):
    """c for fine grids, and its change with the last refinement after extrapolation."""
    lengths, weights = bond_lengths(shape, exponent, dimension)
    coarse, middle, fine = (half_line_shift(lengths, weights, count) for count in (60, 120, 240))
    return fine + (fine - middle) / 3.0, (fine - middle) / 3.0 - (middle - coarse) / 12.0


def extrapolated(ratios, shifts):
    """Limit through the last two values if the rest falls like m^(-3/2), and its change if it falls like m^(-2)."""
    if len(shifts) < 2:
        return np.nan, np.nan
    gained = shifts[-1] - shifts[-2]
    slow, quick = (shifts[-1] + gained / ((ratios[-1] / ratios[-2]) ** power - 1.0) for power in (1.5, 2.0))
    return slow, slow - quick


def print_row(kernel, exponent, dimension, options):
    shape = shapes(options.sharpness)[kernel]
    results = [grid_shift(shape, exponent, dimension, m, options.rim, options.positions) for m in options.ratios]
    shifts = [mean for mean, _ in results]
    limit, change = limit_shift(shape, exponent, dimension)
    bound = closed_bound(*bond_lengths(shape, exponent, dimension))
    value, doubt = extrapolated(options.ratios, shifts)
    row = ", ".join(f"{value:.4f}" for value in [*shifts, limit])
    print(f"{{{row}}},  // {kernel}, exponent {exponent}, {dimension}-D")
    print("//  spread " + " ".join(f"{spread:.4f}" for _, spread in results))
    print(f"//  extrapolated {value:.4f} +- {abs(doubt):.4f}, limit {limit:.5f} +- {abs(change):.5f}, bound {bound:.5f}",
          flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kernels", default="constant,linear,quadratic,gaussian")
    parser.add_argument("--exponents", default="0,1,2")
    parser.add_argument("--dimensions", default="2,3")
    parser.add_argument("--ratios", default=RATIOS, type=lambda text: [float(word) for word in text.split(",")])
    parser.add_argument("--rim", default=6.0, type=float, help="radius of the patch in horizons")
    parser.add_argument("--positions", default=8, type=int, help="positions of the tip between two columns")
    parser.add_argument("--sharpness", default=2.0, type=float, help="of the gaussian kernel")
    options = parser.parse_args()
    for kernel in options.kernels.split(","):
        for dimension in options.dimensions.split(","):
            for exponent in options.exponents.split(","):
                print_row(kernel, int(exponent), int(dimension), options)


if __name__ == "__main__":
    main()
