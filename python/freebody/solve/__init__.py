"""One instant solved: accelerations, reactions, free-body diagrams as data, equilibrium."""
