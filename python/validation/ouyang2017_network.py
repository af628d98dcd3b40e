# SPDX-License-Identifier: BSD-3-Clause
"""The specimen as a linear network of the paper's bonds, solved at rest without the engine: a check of its moduli.

Energy of a bond (Eqs. 1-5 at small strain): d0/2 (k_n e_n^2 + k_s e_s^2) + k_m/2 (theta_i - theta_j)^2."""
import random

import numpy


class Network:
    """Discs and bonds of the first frame of a run. Displacements are arrays (discs, 3): x, y, rotation."""

    def __init__(self, run):
        particles = run.particles[0]
        self.at, self.radius = particles.points[:, :2], particles["radius"]
        self.bonds = run.bonds[0].ends
        x, y, r = self.at[:, 0], self.at[:, 1], self.radius
        low = (y - r).min()
        self.height, self.width = (y + r).max() - low, (x + r).max() - (x - r).min()
        self.largest = r.max()
        self.lower, self.upper = y - low <= self.largest, low + self.height - y <= self.largest

    def uniform_strain(self, kn, ks):
        """Modulus [Pa] if all discs moved with a uniform strain in an isotropic specimen: an upper bound."""
        s = ks / kn
        lengths = numpy.linalg.norm(self.at[self.bonds[:, 1]] - self.at[self.bonds[:, 0]], axis=1).sum()
        axial, lateral = (3 + s) / 8, (1 - s) / 8
        return kn * lengths / self.width / self.height * (axial - lateral ** 2 / axial)

    def _forces(self, kn, ks, km, reference_length, drop, harmonic):
        """A function of displacements (n, 3) that gives forces and moments (n, 3), and the diagonal of its matrix."""
        chance, n = random.Random(1), len(self.at)
        kept = numpy.array([chance.random() >= drop for _ in self.bonds])
        i, j = self.bonds[kept].T
        branch = self.at[j] - self.at[i]
        d = numpy.hypot(*branch.T)
        nx, ny = branch.T / d
        ri, rj = self.radius[i], self.radius[j]
        share = 2 * ri * rj / (ri + rj) / self.largest if harmonic else numpy.ones(len(d))
        stiff = share / (reference_length or d)
        an, at, am = kn * stiff, ks * stiff, km * share

        def gathered(of_i, of_j):
            """Sums over the bonds of each disc, of three numbers a bond."""
            return numpy.stack([numpy.bincount(i, a, n) + numpy.bincount(j, b, n) for a, b in zip(of_i, of_j)], axis=1)

        def force(u):
            ux, uy, _ = (u[j] - u[i]).T
            wi, wj = u[i, 2], u[j, 2]
            normal, shear = an * (nx * ux + ny * uy), at * (nx * uy - ny * ux - ri * wi - rj * wj)
            fx, fy, bend = normal * nx - shear * ny, normal * ny + shear * nx, am * (wi - wj)
            return gathered((-fx, -fy, bend - ri * shear), (fx, fy, -bend - rj * shear))
        along, across = an * nx * nx + at * ny * ny, an * ny * ny + at * nx * nx
        return force, gathered((along, across, at * ri ** 2 + am), (along, across, at * rj ** 2 + am))

    def tension(self, kn, ks, km, reference_length=None, rotations=True, drop=0.0, harmonic=False):
        """Modulus [Pa] and Poisson's ratio (of the gauges) for ends held as by `direct_tension`, 1 m thick. With a `reference_length` [m]
        forces go with displacements over this instead of over d0; `drop` leaves out this share of the bonds at random; `harmonic`: all
        stiffnesses of a bond times the harmonic mean of its radii over the largest radius."""
        x, y = self.at.T
        force, diagonal = self._forces(kn, ks, km, reference_length, drop, harmonic)
        held = self.lower | self.upper
        free = numpy.where(held[:, None], 0.0, [1.0, 1.0, float(rotations)])
        inverse = numpy.divide(free, diagonal, out=numpy.zeros_like(free), where=diagonal != 0)
        u = numpy.zeros((len(x), 3))
        u[:, 1] = numpy.where(self.upper, 1.0, numpy.where(self.lower, 0.0, (y - y.min()) / self.height))
        # Conjugate gradients, preconditioned by the diagonal.
        residual = -force(u) * free
        p = z = residual * inverse
        rho = (residual * z).sum()
        stop = 1e-12 * rho
        while rho > stop:
            q = force(p) * free
            alpha = rho / (p * q).sum()
            u = u + alpha * p
            residual = residual - alpha * q
            z = residual * inverse
            rho, before = (residual * z).sum(), rho
            p = z + rho / before * p
        pull = force(u)[self.upper, 1].sum()
        strain = 1 / (self._heights(self.upper, held) - self._heights(self.lower, held))
        middle = (y.min() + y.max()) / 2
        sides = [numpy.argsort(numpy.hypot(x - edge, y - middle), kind="stable")[:4] for edge in (x.min(), x.max())]
        lateral = u[sides[1], 0].mean() - u[sides[0], 0].mean()
        return pull / self.width / strain, -lateral / (x[sides[1]].mean() - x[sides[0]].mean()) / strain

    def _heights(self, side, held):
        """Mean height of the held discs of one end that are bonded to free ones."""
        i, j = self.bonds.T
        touching = numpy.union1d(i[side[i] & ~held[j]], j[side[j] & ~held[i]])
        return self.at[touching, 1].mean()
