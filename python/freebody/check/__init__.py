"""Is my equation right? Statements of a person against the mechanics of a model."""
