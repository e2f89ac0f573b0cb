"""The model language: files, the builder, and what both become for the core.

- ``file``: ``load``, ``loads``, ``save``, ``dumps``; ``errors.ModelFileError`` tells all that is wrong, with places.
- ``mechanism``: ``Mechanism``, which says in Python what a file says.
- ``schema``: ``Model``, the language as types, and ``schema()``, its JSON Schema.
- ``lower``: ``lower``, from a ``Model`` to the spec of the core, with start, run and report.
- ``units``: quantities and dimensions.

The modules are imported one by one, so that looking at one costs no more than that.
"""
