"""How a mechanism behaves near a state: linear equations in numbers, equilibria, modes, frequency response."""
