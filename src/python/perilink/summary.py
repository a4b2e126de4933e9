"""Types of summary.json and of the tables of a run (docs/outputs.md)."""

from __future__ import annotations

from typing import TypedDict


class Crack(TypedDict, total=False):
    """A crack of the last row."""

    bonds: int
    middle: list[float]
    length: float
    normal: list[float]
    mean_opening: float
    largest_opening: float
    widest_at: list[float]
    face_opening: float
    bar: int
    bar_opening: float


class Stage(TypedDict, total=False):
    """A stage of a damage run."""

    name: str
    loads: str
    status: str
    reason: str
    load_factor: float
    load: float
    displacement: float
    broken_bonds: int
    steps: int
    peak_load: float
    peak_displacement: float


class Summary(TypedDict, total=False):
    """Contents of summary.json; kinds of runs have different keys."""

    title: str
    units: str
    analysis: str
    model: str
    status: str
    reason: str
    peak_load: float
    peak_displacement: float
    first_peak_load: float
    first_peak_displacement: float
    largest_load: float
    largest_load_displacement: float
    peak_load_other_sign: float
    peak_displacement_other_sign: float
    smoothed_peak_load: float
    peak_reaction: float
    initial_stiffness: float
    largest_compression: float
    diffuse_energy: float
    stages: list[Stage]
    cracks: list[Crack]
    steps: int
    rows: int
    time: float
    time_step: float
    critical_time_step: float
    broken_bonds: int
    cracked_particles: int
    yield_events: int
    external_work: float
    kinetic_energy: float
    strain_energy: float
    damped_energy: float
    dissipated_energy: float
    energy_error: float
    largest_residual: float
    warnings: list[str]
    notes: list[str]
    particles: int
    bonds: int
    unknowns: int
    spacing: float
    horizon: float
    factorizations: int
    factor_bytes: float
    iterations: int
    seconds: dict[str, float]
    peak_memory_bytes: float
    threads: int
    version: str
    commit: str
