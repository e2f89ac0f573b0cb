"""Code that computes the accelerations and all reactions of a mechanism by itself, in Python or C."""
