"""The recurrence of `derivation.rs` with FLINT (pip install python-flint).

    cargo run --release -p coadjoint-symbolic --example derivation -- --export \
        | python3 symbolic/examples/derivation_flint.py [NAME]

Reads algebras and Hamiltonians as exported, runs the same incremental recurrence (exponential
chart, odd orders only, zero coefficients skipped, Hamiltonian in nested form) on multivariate
rationals, and prints time and terms in the same columns.
"""

import sys
import time

from flint import Ordering, fmpq, fmpq_mpoly_ctx


def read(lines):
    cases = []
    for line in lines:
        kind, *rest = line.split()
        if kind == "case":
            case = {"name": " ".join(rest), "structure": [], "terms": []}
            cases.append(case)
        elif kind in ("dim", "variables"):
            case[kind] = int(rest[0])
        elif kind == "truncations":
            case[kind] = [int(k) for k in rest]
        elif kind == "c":
            i, j, k = map(int, rest[:3])
            case["structure"].append((i, j, k, rational(rest[3])))
        elif kind == "h":
            case["terms"].append((rational(rest[0]), [int(v) for v in rest[1:]]))
    return cases


def rational(text):
    numerator, _, denominator = text.partition("/")
    return fmpq(int(numerator), int(denominator or 1))


def bernoulli_weights(last):
    """(-1)^k B_k / k!, from (e^z - 1)/z times the series being one."""
    inverse_factorial = [fmpq(1)]
    for k in range(1, last + 2):
        inverse_factorial.append(inverse_factorial[-1] / k)
    weights = [fmpq(1)]
    for k in range(1, last + 1):
        weights.append(-sum((weights[j] * inverse_factorial[k - j + 1] for j in range(k)), fmpq(0)))
    if last >= 1:
        weights[1] = -weights[1]
    return weights


class Horner:
    """Nodes constant + sum of momentum times node, shared when equal."""

    def __init__(self, dimension, context, terms):
        self.dimension, self.context, self.nodes, self.known = dimension, context, [], {}
        self.root = self.insert(tuple(sorted((tuple(sorted(f)), str(c)) for c, f in terms)))

    def insert(self, terms):
        if terms in self.known:
            return self.known[terms]
        constant, parts = self.context.constant(0), {}
        for factors, value in terms:
            momenta = [v for v in factors if v < self.dimension]
            if momenta:
                rest = list(factors)
                rest.remove(momenta[0])
                parts.setdefault(momenta[0], []).append((tuple(rest), value))
            else:
                term = self.context.constant(rational(value))
                for v in factors:
                    term = term * self.context.gen(v)
                constant = constant + term
        branches = [(a, self.insert(tuple(part))) for a, part in sorted(parts.items())]
        self.nodes.append((constant, branches, []))
        self.known[terms] = len(self.nodes) - 1
        return len(self.nodes) - 1

    def extend(self, momenta, order):
        for constant, branches, series in self.nodes:
            value = constant if order == 0 else self.context.constant(0)
            for a, child in branches:
                below = self.nodes[child][2]
                for i in range(order + 1):
                    if momenta[a][i] and below[order - i]:
                        value = value + momenta[a][i] * below[order - i]
            series.append(value)
        return self.nodes[self.root][2][order]


def derive(case, truncation):
    n = case["dim"]
    names = [f"v{i}" for i in range(case["variables"])]
    context = fmpq_mpoly_ctx.get(names, Ordering.lex)
    zero = context.constant(0)
    weights = bernoulli_weights(truncation)
    p = [[context.gen(i)] for i in range(n)]
    x = [[zero] for _ in range(n)]
    body = [[] for _ in range(n)]
    powers = []
    energy = Horner(n, context, case["terms"])
    orders = [zero]
    for k in range(1, truncation + 1):
        order = k - 1
        value = [p[i][0] if order == 0 else zero for i in range(n)]
        if order > 0:
            powers.append([[zero] * order for _ in range(n)])
        for j in range(1, order + 1):
            below = p if j == 1 else powers[j - 2]
            new = [zero] * n
            for a, b, c, constant in case["structure"]:
                for i in range(1, order + 1):
                    if order - i < len(below[c]) and x[a][i] and below[c][order - i]:
                        new[b] = new[b] + constant * (x[a][i] * below[c][order - i])
            for i in range(n):
                powers[j - 1][i].append(new[i])
                if weights[j]:
                    value[i] = value[i] + weights[j] * new[i]
        for i in range(n):
            body[i].append(value[i])
        coefficient = energy.extend(body, order)
        orders.append(zero if k % 2 == 0 else coefficient / k)
        for i in range(n):
            x[i].append(orders[k].derivative(i))
    return orders


def main():
    print(f"{'system':<28} {'n':>4} {'K':>3} {'time':>12} {'S_K':>8} {'all S_k':>9}")
    for case in read(sys.stdin):
        if len(sys.argv) > 1 and sys.argv[1] not in case["name"]:
            continue
        for truncation in case["truncations"]:
            best, begin = None, time.perf_counter()
            while best is None or time.perf_counter() - begin < 1:
                start = time.perf_counter()
                orders = derive(case, truncation)
                elapsed = time.perf_counter() - start
                best = elapsed if best is None else min(best, elapsed)
            sizes = [len(s) for s in orders[1:]]
            print(
                f"{case['name']:<28} {case['variables']:>4} {truncation:>3} {best * 1e3:>10.2f}ms"
                f" {sizes[-1]:>8} {sum(sizes):>9}",
                flush=True,
            )


main()
