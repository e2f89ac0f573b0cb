"""The model language: files, the builder, and what both become for the core.

- ``reading``, ``file``: read and written; ``errors.ModelFileError`` tells all that is wrong, with places.
- ``builder``: ``Builder``, which says in Python what a file says.
- ``schema``: ``Model``, the language as types, and ``schema()``, its JSON Schema.
- ``lower``: ``lower``, from a ``Model`` to the spec of the core, with start, run and report.
- ``units``: quantities and dimensions.
"""
