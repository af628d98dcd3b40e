#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Time of a step on many ranks, from what was measured and what networks are said to do, as Markdown: scaling_model.py [OPTION...]

Of a packing in Morton order, cut into as many ranges of whole blocks as there are ranks, the halo, the neighbours and the pairs that two ranks
both evaluate are counted, not assumed: a jittered lattice stands for the packing. The rest are the options. No rank waits for another here, but
for the sums that all take part in: what is out of balance comes on top.
"""
import argparse
import math

import numpy

BLOCK = 256  # particles that stay together (core/engine/chunks.hpp)


def spread(v):
    """The bits of 21-bit numbers, two zeros behind each."""
    v = v.astype(numpy.uint64)
    for shift, mask in ((32, 0x1F00000000FFFF), (16, 0x1F0000FF0000FF), (8, 0x100F00F00F00F00F), (4, 0x10C30C30C30C30C3), (2, 0x1249249249249249)):
        v = (v | (v << numpy.uint64(shift))) & numpy.uint64(mask)
    return v


def packing(edge, reach):
    """Pairs (pairs, 2) of edge^3 particles, by their places in Morton order."""
    count, random = edge ** 3, numpy.random.default_rng(1)
    position = numpy.indices((edge,) * 3).reshape(3, -1).T + 0.5 + 0.3 * (random.random((count, 3)) - 0.5)
    cell = (position / edge * 1024).astype(int)
    code = spread(cell[:, 0]) | (spread(cell[:, 1]) << numpy.uint64(1)) | (spread(cell[:, 2]) << numpy.uint64(2))
    order = numpy.argsort(code)
    place = numpy.empty(count, dtype=numpy.int64)
    place[order] = numpy.arange(count)
    position, grid, pairs = position[order], place.reshape((edge,) * 3), []
    for step in numpy.ndindex(3, 3, 3):
        d = numpy.array(step) - 1
        if tuple(d) <= (0, 0, 0):
            continue
        here = tuple(slice(max(0, -k), edge - max(0, k)) for k in d)
        there = tuple(slice(max(0, k), edge - max(0, -k)) for k in d)
        i, j = grid[here].ravel(), grid[there].ravel()
        near = ((position[i] - position[j]) ** 2).sum(1) < reach ** 2
        pairs.append(numpy.stack([i[near], j[near]], 1))
    return numpy.concatenate(pairs)


def cut(pairs, count, ranks):
    """Halo particles and neighbours of the rank that has most of them, and the share of pairs that are evaluated twice."""
    blocks = -(-count // BLOCK)
    owner = numpy.arange(count) // BLOCK * ranks // blocks
    a, b = owner[pairs[:, 0]], owner[pairs[:, 1]]
    apart = a != b
    seen = numpy.concatenate([pairs[apart, 0], pairs[apart, 1]]) * ranks + numpy.concatenate([b[apart], a[apart]])
    seen = numpy.unique(seen)
    halo = numpy.bincount(seen % ranks, minlength=ranks).max()
    links = numpy.unique(owner[seen // ranks] * ranks + seen % ranks)
    return halo, numpy.bincount(links % ranks, minlength=ranks).max(), apart.mean()


def main():
    p = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    p.add_argument("--ns", type=float, default=28, help="of a pair and step on one core where the caches hold the particles (default 28)")
    p.add_argument("--ns-memory", type=float, default=40, help="and where they do not (default 40)")
    p.add_argument("--cached", type=float, default=10000, help="particles of a core that its caches hold (default 10000)")
    p.add_argument("--pairs", type=float, default=5.76, help="pairs of a particle (default 5.76: the packing of tests/bench)")
    p.add_argument("--bytes", type=float, default=96, help="sent for a halo particle in each step (default 96)")
    p.add_argument("--sums", type=int, default=2, help="sums over all ranks in a step (default 2)")
    p.add_argument("--sum-bytes", type=float, default=4096, help="bytes of them together (default 4096)")
    p.add_argument("--latency", type=float, default=1.3, help="of a message [us] (default 1.3)")
    p.add_argument("--overhead", type=float, default=0.3, help="of a message, for the core that sends it [us] (default 0.3)")
    p.add_argument("--node", type=float, default=12.5, help="of a node's port [GB/s] (default 12.5)")
    p.add_argument("--cores", type=int, default=64, help="of a node that share it (default 64)")
    p.add_argument("--memory", type=float, default=1.5, help="what each core of a node copies to others of it [GB/s] (default 1.5)")
    o = p.parse_args()

    edge = 100
    pairs = packing(edge, 1.42)
    shapes = {ranks: cut(pairs, edge ** 3, ranks) for ranks in (2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048)}

    def part(own, ranks):
        """Halo, neighbours and share of doubled pairs of a range of so many particles: those of the cut whose ranges are nearest in size."""
        if ranks == 1:
            return 0, 0, 0
        nearest = min(shapes, key=lambda r: abs(math.log(edge ** 3 / r / own)))
        halo, links, share = shapes[nearest]
        scale = (own / (edge ** 3 / nearest)) ** (2 / 3)
        return halo * scale, min(links, ranks - 1), share * scale * edge ** 3 / nearest / own

    def step(count, ranks):
        """Microseconds, and those of them that are messages and sums."""
        own = count / ranks
        halo, links, share = part(own, ranks)
        nodes = -(-ranks // o.cores)  # what leaves a node is the halo of all that its cores own
        leaves = part(count / nodes, nodes)[0]
        ns = o.ns if own <= o.cached else o.ns_memory
        work = own * o.pairs * (1 + share) * ns * 1e-3
        if ranks == 1:
            return work, 0.0
        hops = math.ceil(math.log2(ranks))
        halo_us = o.latency + links * o.overhead + o.bytes * (halo / o.memory + leaves / o.node) * 1e-3
        sums_us = hops * (o.sums * o.latency + o.sum_bytes / (o.node * 1e3))
        return work + halo_us + sums_us, halo_us + sums_us

    ladder = (1, 2, 8, 64, 128, 256, 512, 1024, 2048, 4096)
    print("| cores | " + " | ".join(f"{n:.0e} particles: ms a step | efficiency | particles a core" for n in (1e6, 1e7, 1e8)) + " |")
    print("|---" * 10 + "|")
    for ranks in ladder:
        cells = []
        for count in (1e6, 1e7, 1e8):
            alone, (time, _) = step(count, 1)[0], step(count, ranks)
            cells.append(f"{time / 1e3:.3g} | {100 * alone / ranks / time:.0f} % | {count / ranks:.0f}")
        print(f"| {ranks} | " + " | ".join(cells) + " |")
    print()
    for count in (1e6, 1e7, 1e8):
        for ranks in ladder[1:]:
            time, talk = step(count, ranks)
            if talk > time / 2:
                print(f"{count:.0e} particles: from {ranks} cores on ({count / ranks:.0f} particles each) more than half of the step is messages and sums.")
                break
    print("\n| ranks of 1e6 particles | particles of a rank | halo | neighbours | pairs evaluated twice |\n|---|---|---|---|---|")
    for ranks, (halo, links, share) in shapes.items():
        print(f"| {ranks} | {edge ** 3 // ranks} | {halo} | {links} | {100 * share:.1f} % |")


main()
