"""Motions: simulation, sampling, mode changes, sequences of models, storage, comparison."""
