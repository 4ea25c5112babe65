#!/usr/bin/env python3
"""Ensembles on a graphics card beside all cores of its host: time of the kernel, and of everything around it.

    cargo build --release -p coadjoint-cli
    python3 bench/peers/cards.py target/release/coadjoint [--device cuda|opencl] [--scale 1]

Needs NumPy, and NVIDIA's driver and NVRTC for `cuda`. Each system makes 500 steps with its file's parameters from random momenta. The
card's double precision is run twice, of which the second is told, and compared bit for bit with the host's cores.
"""
import argparse
import json
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
# Dimension, step, rows.
SYSTEMS = {
    "rigid_body": (3, 0.1, 2_000_000),
    "gyrostat": (3, 0.05, 2_000_000),
    "heavy_top": (6, 0.02, 1_000_000),
    "kirchhoff_body": (6, 0.1, 500_000),
    "su3_quadratic": (8, 0.05, 100_000),
    "relativistic_body": (3, 0.2, 500_000),
}
STEPS = 500


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("--device", default="cuda")
    parser.add_argument("--scale", type=float, default=1)
    asked = parser.parse_args()
    random = np.random.default_rng(7)
    for system, (dim, step, rows) in SYSTEMS.items():
        rows = int(rows * asked.scale)
        with tempfile.TemporaryDirectory() as folder:
            initial, out = os.path.join(folder, "initial.npy"), os.path.join(folder, "out.npy")

            def ensemble(*more, count):
                np.save(initial, momenta[:count])
                line = [asked.command, "ensemble", str(EXAMPLES / f"{system}.toml"), "--initial", initial, "--out", out, "--restart"]
                line += ["--step", str(step), "--time", str(round(step * STEPS, 6)), "--format", "json", *more]
                found = json.loads(subprocess.run(line, capture_output=True, text=True, check=True).stdout)
                kernel = (found.get("device") or {}).get("seconds", 0)
                return found["seconds"], kernel, np.load(out)

            momenta = random.normal(size=(rows, dim)) * 0.6
            card = ["--device", asked.device]
            ensemble(*card, count=rows)
            whole, kernel, ends = ensemble(*card, count=rows)
            single, of_single, _ = ensemble(*card, "--precision", "single", count=rows)
            part = min(rows, 100_000)
            host, _, beside = ensemble("--backend", "c", count=part)
            same = np.array_equal(ends[:part], beside, equal_nan=True)
            print(
                f"{system}, {rows} rows: {whole:.3f} s, of which the kernel {kernel:.3f} s = {kernel / rows / STEPS * 1e9:.3f} ns a step; "
                f"single precision {single:.3f} s, {of_single:.3f} s; {os.cpu_count()} cores {host / part / STEPS * 1e9:.2f} ns a step; "
                f"{'the same' if same else 'other'} bits",
                flush=True,
            )


if __name__ == "__main__":
    main()
