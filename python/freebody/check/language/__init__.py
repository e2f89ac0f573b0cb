"""The language of equations: what people write, read into trees, spelled back and evaluated."""
