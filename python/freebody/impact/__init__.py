"""Impacts of a run, and an impulse applied to a model at rest."""
