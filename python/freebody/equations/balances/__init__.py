"""The smallest set of balance equations for what is wanted, and the minimal form; both at an instant, in numbers."""
