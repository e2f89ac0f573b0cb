"""Derivations as documents: blocks, and their rendering."""
