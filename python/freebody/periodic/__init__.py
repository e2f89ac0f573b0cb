"""Motions that come back: return maps with their derivatives, periodic motions, multipliers, boundaries of stability."""
