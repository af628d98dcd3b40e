# SPDX-License-Identifier: BSD-3-Clause
"""The specimen as a linear network of the paper's bonds, solved at rest without the engine: a check of its moduli.

Energy of a bond (Eqs. 1-5 at small strain): d0/2 (k_n e_n^2 + k_s e_s^2) + k_m/2 (theta_i - theta_j)^2."""
import base64
import math
import random
import re
import struct


def _lz4(data):
    """One block of the LZ4 format."""
    out, k = bytearray(), 0
    while k < len(data):
        token = data[k]
        k += 1
        length = token >> 4
        if length == 15:
            while True:
                length += data[k]
                k += 1
                if data[k - 1] != 255:
                    break
        out += data[k:k + length]
        k += length
        if k >= len(data):
            break
        back = data[k] | data[k + 1] << 8
        k += 2
        length = (token & 15) + 4
        if length == 19:
            while True:
                length += data[k]
                k += 1
                if data[k - 1] != 255:
                    break
        for _ in range(length):
            out.append(out[-back])
    return bytes(out)


def array(text, name, section=""):
    """An array of a .vtp file as `output: vtk` writes them: inline, 32 bit headers, LZ4."""
    text = text[text.index(f"<{section}>"):] if section else text
    kind, body = re.search(rf'<DataArray type="(\w+)" Name="{name}"[^>]*>\s*([A-Za-z0-9+/=]+)', text).groups()
    blocks = struct.unpack("<I", base64.b64decode(body[:8])[:4])[0]
    head = 4 * math.ceil(4 * (3 + blocks) / 3)
    sizes = struct.unpack(f"<{3 + blocks}I", base64.b64decode(body[:head])[:4 * (3 + blocks)])
    data, out, at = base64.b64decode(body[head:]), b"", 0
    for k, size in enumerate(sizes[3:]):
        full = sizes[2] if k == blocks - 1 and sizes[2] else sizes[1]
        part = data[at:at + size]
        out += part if size == full else _lz4(part)
        at += size
    code = {"Float64": "d", "Float32": "f", "Int32": "i", "Int64": "q"}[kind]
    return struct.unpack(f"<{len(out) // struct.calcsize(code)}{code}", out)


class Network:
    """Discs and bonds of the first frame of a run."""

    def __init__(self, folder):
        particles = (folder / "particles_000000.vtp").read_text()
        bonds = (folder / "bonds_000000.vtp").read_text()
        points, self.radius = array(particles, "Points"), array(particles, "radius")
        self.x, self.y = points[0::3], points[1::3]
        ends = array(bonds, "connectivity", "Lines")
        self.bonds = list(zip(ends[0::2], ends[1::2]))
        low = min(y - r for y, r in zip(self.y, self.radius))
        self.height = max(y + r for y, r in zip(self.y, self.radius)) - low
        self.width = max(x + r for x, r in zip(self.x, self.radius)) - min(x - r for x, r in zip(self.x, self.radius))
        self.largest = max(self.radius)
        self.lower = {k for k, y in enumerate(self.y) if y - low <= self.largest}
        self.upper = {k for k, y in enumerate(self.y) if low + self.height - y <= self.largest}

    def uniform_strain(self, kn, ks):
        """Modulus [Pa] if all discs moved with a uniform strain in an isotropic specimen: an upper bound."""
        s = ks / kn
        lengths = sum(math.hypot(self.x[j] - self.x[i], self.y[j] - self.y[i]) for i, j in self.bonds)
        axial, lateral = (3 + s) / 8, (1 - s) / 8
        return kn * lengths / self.width / self.height * (axial - lateral ** 2 / axial)

    def tension(self, kn, ks, km, reference_length=None, rotations=True, drop=0.0, harmonic=False):
        """Modulus [Pa] and Poisson's ratio (of the gauges) for ends held as by `direct_tension`, 1 m thick. With a `reference_length` [m]
        forces go with displacements over this instead of over d0; `drop` leaves out this share of the bonds at random; `harmonic`: all
        stiffnesses of a bond times the harmonic mean of its radii over the largest radius."""
        n, held = len(self.x), self.lower | self.upper
        terms, chance = [], random.Random(1)
        for i, j in self.bonds:
            if chance.random() < drop:
                continue
            dx, dy = self.x[j] - self.x[i], self.y[j] - self.y[i]
            d = math.hypot(dx, dy)
            ri, rj = self.radius[i], self.radius[j]
            share = 2 * ri * rj / (ri + rj) / self.largest if harmonic else 1.0
            stiff = share / (reference_length or d)
            terms.append((3 * i, 3 * j, dx / d, dy / d, ri, rj, kn * stiff, ks * stiff, km * share))
        free = [0.0 if k // 3 in held or not rotations and k % 3 == 2 else 1.0 for k in range(3 * n)]

        def force(u):
            f = [0.0] * (3 * n)
            for i, j, nx, ny, ri, rj, an, at, am in terms:
                ux, uy, wi, wj = u[j] - u[i], u[j + 1] - u[i + 1], u[i + 2], u[j + 2]
                normal, shear = an * (nx * ux + ny * uy), at * (nx * uy - ny * ux - ri * wi - rj * wj)
                fx, fy, bend = normal * nx - shear * ny, normal * ny + shear * nx, am * (wi - wj)
                f[i] -= fx
                f[i + 1] -= fy
                f[j] += fx
                f[j + 1] += fy
                f[i + 2] += bend - ri * shear
                f[j + 2] += -bend - rj * shear
            return f
        diagonal = [0.0] * (3 * n)
        for i, j, nx, ny, ri, rj, an, at, am in terms:
            for k, r in ((i, ri), (j, rj)):
                diagonal[k] += an * nx * nx + at * ny * ny
                diagonal[k + 1] += an * ny * ny + at * nx * nx
                diagonal[k + 2] += at * r * r + am
        inverse = [m / d if d else 0.0 for m, d in zip(free, diagonal)]
        u = [0.0] * (3 * n)
        for k in range(n):
            u[3 * k + 1] = 1.0 if k in self.upper else 0.0 if k in self.lower else (self.y[k] - min(self.y)) / self.height
        residual = [-f * m for f, m in zip(force(u), free)]
        z = [r * d for r, d in zip(residual, inverse)]
        p, rho = z[:], sum(a * b for a, b in zip(residual, z))
        stop = 1e-12 * rho
        while rho > stop:
            q = [f * m for f, m in zip(force(p), free)]
            alpha = rho / sum(a * b for a, b in zip(p, q))
            u = [a + alpha * b for a, b in zip(u, p)]
            residual = [a - alpha * b for a, b in zip(residual, q)]
            z = [r * d for r, d in zip(residual, inverse)]
            rho, before = sum(a * b for a, b in zip(residual, z)), rho
            p = [a + rho / before * b for a, b in zip(z, p)]
        load = force(u)
        pull = sum(load[3 * k + 1] for k in self.upper)
        touching = [{a for i, j in self.bonds for a, b in ((i, j), (j, i)) if a in side and b not in held} for side in (self.lower, self.upper)]
        length = sum(self.y[k] for k in touching[1]) / len(touching[1]) - sum(self.y[k] for k in touching[0]) / len(touching[0])
        middle = sum((min(self.y), max(self.y))) / 2
        sides = [sorted(range(n), key=lambda k: math.hypot(self.x[k] - edge, self.y[k] - middle))[:4] for edge in (min(self.x), max(self.x))]
        gauge = [sum(self.x[k] for k in s) / 4 for s in sides]
        lateral = sum(u[3 * k] for k in sides[1]) / 4 - sum(u[3 * k] for k in sides[0]) / 4
        strain = 1 / length
        return pull / self.width / strain, -lateral / (gauge[1] - gauge[0]) / strain
