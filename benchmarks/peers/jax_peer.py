"""JAX on the CPU, in double precision."""

from math import gcd

import batch
import jax
import problems
from entry import Entry
from jax import numpy as jnp

GROUP = 250  # members side by side, whose states stay in the cache: as fast as any
DEVICES = gcd(batch.THREADS, batch.MEMBERS // GROUP)
jax.config.update("jax_enable_x64", True)
jax.config.update("jax_platforms", "cpu")
jax.config.update("jax_num_cpu_devices", DEVICES)


def rates(y):
    """Of two bars, at angles from hanging straight down: the equations of benchmarks/batch.py."""
    a, b, va, vb = y
    s, c = jnp.sin(a - b) / 2, jnp.cos(a - b) / 2
    first, second = -s * vb * vb - 1.5 * batch.G * jnp.sin(a), s * va * va - 0.5 * batch.G * jnp.sin(b)
    det = 4 / 9 - c * c
    return jnp.stack([va, vb, (first / 3 - c * second) / det, (second * 4 / 3 - c * first) / det])


def swung(y):
    """A group, by RK4."""

    def step(_, y):
        h = batch.STEP
        k1 = rates(y)
        k2 = rates(y + h / 2 * k1)
        k3 = rates(y + h / 2 * k2)
        return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rates(y + h * k3))

    return jax.lax.fori_loop(0, batch.STEPS, step, y)


def pendulums():
    fan = problems.fan()
    groups = jnp.array(fan.reshape(DEVICES, -1, GROUP, 2).transpose(0, 1, 3, 2))
    start, run = jnp.concatenate([groups, jnp.zeros(groups.shape)], axis=2), jax.pmap(lambda y: jax.lax.map(swung, y))

    def read(y):
        return y.transpose(0, 1, 3, 2).reshape(-1, 4)[:, :2]

    says = f"equations and RK4 by hand, compiled by XLA; {GROUP} side by side, on all cores"
    yield Entry("JAX", lambda _: run(start).block_until_ready(), says=says, read=read)
